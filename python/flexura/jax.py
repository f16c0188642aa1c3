"""Equilibria as functions of JAX: differentiable forwards and backwards, and mapped over batches.

The derivative comes from the equilibrium itself, one linear solve with the factorised tangent, not from differences of solves
nor from what the solver did on its way.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Literal

import jax
import jax.numpy as jnp
import numpy as np

from .derivatives import Equilibrium
from .records import Array

if TYPE_CHECKING:
    from .model import Model


def function(
    model: Model,
    parameters: Sequence[Any],
    outputs: Sequence[Any],
    *,
    tolerance: float = 1e-10,
    failed: Literal["raise", "nan"] = "raise",
) -> Callable[[Any], jax.Array]:
    """The outputs of a model's equilibrium as a function of some parameters.

    Args:
        parameters: names of n parameters; the function takes an array (n,), SI units.
        outputs: names of outputs; it gives an array (k,), a vector as three numbers.
        failed: where there is no equilibrium: an exception, or NaN.

    Returns:
        A function for ``jax.grad``, ``jax.jacobian``, ``jax.jvp``, ``jax.vmap`` and ``jax.jit``. A batch is solved one by one.
        Give it ``jax.config.update("jax_enable_x64", True)``: without, numbers have seven digits, which is warned of.
    """
    equilibrium = Equilibrium(model, parameters, outputs, tolerance, failed)
    n, k = len(equilibrium.parameters), equilibrium.size

    def values(x: Any) -> Array:
        return equilibrium.values(np.asarray(x, dtype=float)).astype(x.dtype)

    def both(x: Any) -> tuple[Array, Array]:
        y, jacobian = equilibrium.both(np.asarray(x, dtype=float))
        return y.astype(x.dtype), jacobian.astype(x.dtype)

    def shape(dtype: Any, *sizes: int) -> Any:
        return jax.ShapeDtypeStruct(sizes, dtype)  # type: ignore[no-untyped-call, unused-ignore]

    @jax.custom_jvp
    def f(x: jax.Array) -> jax.Array:
        found: jax.Array = jax.pure_callback(values, shape(x.dtype, k), x, vmap_method="sequential")
        return found

    @f.defjvp
    def derivative(primals: tuple[jax.Array], tangents: tuple[jax.Array]) -> tuple[jax.Array, jax.Array]:
        (x,), (tangent,) = primals, tangents
        shapes = (shape(x.dtype, k), shape(x.dtype, k, n))
        y, jacobian = jax.pure_callback(both, shapes, x, vmap_method="sequential")
        return y, jacobian @ tangent

    def checked(x: Any) -> jax.Array:
        given = jnp.asarray(x, dtype=jnp.result_type(float))
        if given.dtype != jnp.float64:
            warnings.warn("JAX computes with seven digits; jax.config.update('jax_enable_x64', True) mends that", stacklevel=2)
        if given.shape != (n,):
            raise ValueError(f"expected an array ({n},) for {', '.join(equilibrium.parameters)}, found {given.shape}")
        return f(given)

    return checked
