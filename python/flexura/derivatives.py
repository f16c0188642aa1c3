"""Values and Jacobians for frameworks that differentiate."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ._references import Handle
from .errors import ConvergenceError, StudyError
from .records import Array

if TYPE_CHECKING:
    from .model import Model
    from .result import Result


class Equilibrium:
    """Some outputs of a model as a function of some of its parameters."""

    def __init__(
        self, model: Model, parameters: Sequence[Any], outputs: Sequence[Any], tolerance: float, failed: Literal["raise", "nan"]
    ) -> None:
        if failed not in ("raise", "nan"):
            raise StudyError(f"failed is 'raise' or 'nan', not {failed!r}")
        self.model = model
        self.parameters = [name.name if isinstance(name, Handle) else str(name) for name in parameters]
        self.outputs = [name.name if isinstance(name, Handle) else str(name) for name in outputs]
        self._tolerance, self._failed = tolerance, failed
        for name in self.parameters:
            if name not in model.parameters:
                known = ", ".join(model.parameters)
                raise StudyError.at(f"parameter.{name}", f"there is no parameter `{name}`", hint=f"there are {known}")
            if name in model.unknowns:
                raise StudyError.at(f"parameter.{name}", "is an unknown, which a solve finds; there is no derivative by it")
        sizes = {name: count for name, _, count in model._described["outputs"]}
        sizes |= {f"parameter.{name}": 1 for name in model.unknowns}
        for name in self.outputs:
            if name not in sizes:
                raise StudyError.at(f"output.{name}", f"there is no output `{name}`", hint=f"there are {', '.join(sizes)}")
        #: How many numbers come out.
        self.size = sum(sizes[name] for name in self.outputs)

    def _solve(self, x: Array) -> Result | None:
        try:
            return self.model.solve(dict(zip(self.parameters, x.tolist(), strict=True)), tolerance=self._tolerance)
        except ConvergenceError:
            if self._failed == "nan":
                return None
            raise

    def _values(self, result: Result) -> Array:
        values = []
        for name in self.outputs:
            if name.startswith("parameter."):
                values.append(np.atleast_1d(result.parameters[name.removeprefix("parameter.")]))
            elif name in result.outputs:
                values.append(np.atleast_1d(result.outputs[name]))
            else:
                raise StudyError.at(f"output.{name}", result.output_reasons.get(name, "has no value"))
        return np.concatenate(values) if values else np.zeros(0)

    def values(self, x: Array) -> Array:
        """The outputs (k,)."""
        result = self._solve(x)
        return np.full(self.size, np.nan) if result is None else self._values(result)

    def both(self, x: Array) -> tuple[Array, Array]:
        """The outputs (k,) and their derivatives (k, n)."""
        result = self._solve(x)
        if result is None:
            return np.full(self.size, np.nan), np.full((self.size, len(x)), np.nan)
        return self._values(result), result.jacobian(self.outputs, self.parameters)
