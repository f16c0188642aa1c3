/* A loop of control: a frame is led through its loads, and each answer is checked. */
#include "flexura.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define CHECK(what)                                                                          \
    do {                                                                                     \
        if (!(what)) {                                                                       \
            fprintf(stderr, "line %d: %s: %s\n", __LINE__, #what, flexura_message());        \
            return 1;                                                                        \
        }                                                                                    \
    } while (0)

int main(int count, char **arguments) {
    const char *inputs[] = {"load"}, *outputs[] = {"down", "angle"}, *unknown[] = {"laod"};
    flexura_stepper *stepper = NULL;
    CHECK(count == 2 && strlen(flexura_version()) >= 5);
    CHECK(flexura_open("no such file", inputs, 1, outputs, 2, 1e-8, &stepper) == FLEXURA_INPUT_ERROR);
    CHECK(stepper == NULL && strlen(flexura_message()) > 0);
    CHECK(flexura_open(arguments[1], unknown, 1, outputs, 2, 1e-8, &stepper) == FLEXURA_INPUT_ERROR);
    CHECK(strstr(flexura_message(), "did you mean `load`?") != NULL);

    CHECK(flexura_open(arguments[1], inputs, 1, outputs, 2, 1e-8, &stepper) == FLEXURA_CONVERGED);
    CHECK(flexura_input_size(stepper) == 1 && flexura_output_size(stepper) == 2);
    double last = 0.0, out[2];
    for (int i = 1; i <= 180; ++i) {
        double load = 0.01 * i;
        CHECK(flexura_step(stepper, &load, out) == FLEXURA_CONVERGED);
        CHECK(out[0] > last && isfinite(out[1]));
        last = out[0];
    }
    printf("%.9f\n", last);

    double absurd = 1e9, none = NAN;
    CHECK(flexura_step(stepper, &absurd, out) != FLEXURA_CONVERGED && isnan(out[0]));
    CHECK(strlen(flexura_message()) > 0);
    CHECK(flexura_step(stepper, &none, out) == FLEXURA_INPUT_ERROR);
    double load = 1.8;
    flexura_reset(stepper);
    CHECK(flexura_step(stepper, &load, out) == FLEXURA_CONVERGED && strlen(flexura_message()) == 0);
    CHECK(fabs(out[0] - last) < 1e-6 * last);
    flexura_close(stepper);
    flexura_close(NULL);
    return 0;
}
