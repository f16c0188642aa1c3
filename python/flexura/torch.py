"""Equilibria as functions of PyTorch, differentiable backwards."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import torch

from .derivatives import Equilibrium

if TYPE_CHECKING:
    from .model import Model


def function(
    model: Model,
    parameters: Sequence[Any],
    outputs: Sequence[Any],
    *,
    tolerance: float = 1e-10,
    failed: Literal["raise", "nan"] = "raise",
) -> Callable[[Any], Any]:
    """The outputs of a model's equilibrium as a function of some parameters, for ``backward`` and ``torch.autograd``.

    Args:
        parameters: names of n parameters; the function takes a tensor (n,), SI units.
        outputs: names of outputs; it gives a tensor (k,), a vector as three numbers.
        failed: where there is no equilibrium: an exception, or NaN.
    """
    equilibrium = Equilibrium(model, parameters, outputs, tolerance, failed)

    class Solve(torch.autograd.Function):
        @staticmethod
        def forward(context: Any, x: Any) -> Any:
            given = x.detach().cpu().numpy().astype(float)
            if given.shape != (len(equilibrium.parameters),):
                raise ValueError(f"expected a tensor ({len(equilibrium.parameters)},), found {tuple(given.shape)}")
            if context.needs_input_grad[0]:
                values, jacobian = equilibrium.both(given)
                context.jacobian = jacobian
            else:
                values = equilibrium.values(given)
            return torch.as_tensor(np.ascontiguousarray(values), dtype=x.dtype, device=x.device)

        @staticmethod
        @torch.autograd.function.once_differentiable  # type: ignore[untyped-decorator, unused-ignore]
        def backward(context: Any, cotangent: Any) -> Any:
            pulled = cotangent.detach().cpu().numpy().astype(float) @ context.jacobian
            return torch.as_tensor(pulled, dtype=cotangent.dtype, device=cotangent.device)

    def apply(x: Any) -> Any:
        return Solve.apply(x)

    return apply
