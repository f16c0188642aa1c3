/* flexura: equilibria of compliant mechanisms, step by step, for loops of control.
 *
 * A stepper stands at its last equilibrium. Numbers go in (values of parameters, or the wanted values of the model's targets)
 * and come out (outputs, or the unknown parameters), all in SI units and radians. A stepper belongs to one thread at a time;
 * several steppers are independent of each other.
 *
 *     cc loop.c -lflexura_c -lm
 */
#ifndef FLEXURA_H
#define FLEXURA_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How a call ended. All but FLEXURA_CONVERGED leave NaN in what comes out. */
typedef enum {
    FLEXURA_CONVERGED = 0,
    FLEXURA_STALLED = 1,         /* the load cannot grow further on this path */
    FLEXURA_ITERATION_LIMIT = 2, /* all the work that a solve may do was done */
    FLEXURA_SINGULAR = 3,        /* a fold or branch point */
    FLEXURA_INCONSISTENT = 4,    /* joints that cannot all be kept */
    FLEXURA_ACCURACY_LIMIT = 5,  /* double precision gives no more */
    FLEXURA_INTERRUPTED = 6,
    FLEXURA_INPUT_ERROR = 7,     /* the file, a name or a value is wrong */
    FLEXURA_BUG = 8              /* please report it */
} flexura_status;

typedef struct flexura_stepper flexura_stepper;

/* The version, as "0.1.0". */
const char *flexura_version(void);

/* Reads a model file and makes it ready.
 *
 * inputs: names of parameters; none (count 0): the wanted values of the targets go in.
 * outputs: names of outputs, of which a vector gives three numbers; none: the unknown parameters come out.
 * tolerance: relative accuracy, such as 1e-8.
 * stepper: where the new stepper goes; NULL after an error.
 */
flexura_status flexura_open(const char *file, const char *const *inputs, size_t input_count,
                            const char *const *outputs, size_t output_count, double tolerance,
                            flexura_stepper **stepper);

/* How many numbers go in, and how many come out. */
size_t flexura_input_size(const flexura_stepper *stepper);
size_t flexura_output_size(const flexura_stepper *stepper);

/* Goes to the equilibrium for these inputs, from the last one where that is near, and writes what comes out. */
flexura_status flexura_step(flexura_stepper *stepper, const double *in, double *out);

/* The next step begins at rest. */
void flexura_reset(flexura_stepper *stepper);

/* Why the last call of this thread did not do what was asked; empty where it did. Valid until the next call. */
const char *flexura_message(void);

/* Ends a stepper; NULL is no harm. */
void flexura_close(flexura_stepper *stepper);

#ifdef __cplusplus
}
#endif

#endif
