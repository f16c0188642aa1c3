"""Solves one after another, each from where the last one ended."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _native
from ._references import Handle
from .errors import StudyError
from .records import Array

if TYPE_CHECKING:
    from .model import Model


class Step(NamedTuple):
    """How a step ended: a word, and the numbers it found (NaN where it did not converge)."""

    status: str
    values: Array

    @property
    def converged(self) -> bool:
        """Was an equilibrium found?"""
        return self.status == "converged"


class Stepper:
    """A mechanism that is led along, for loops of control.

    ``inputs`` are parameters; none of them: the wanted values of the model's targets. ``outputs`` are outputs; none of them:
    the unknown parameters. A step raises nothing where it does not converge: its status says so, ``reason`` why.

    It belongs to one thread at a time.
    """

    def __init__(self, model: Model, inputs: Sequence[Any] = (), outputs: Sequence[Any] = (), *, tolerance: float = 1e-8) -> None:
        if model.values:
            raise StudyError("a stepper takes the values that stand in the file; give others as inputs")
        self._native = _native.Stepper(model._mechanism, _names(inputs), _names(outputs), tolerance)
        self.sizes: tuple[int, int] = self._native.sizes
        self._room = np.zeros(self.sizes[1])

    def __call__(self, values: Any, out: Array | None = None) -> Step:
        """Goes to the equilibrium for these inputs (SI); writes into ``out``, an array of the class where none is given."""
        given = np.ascontiguousarray(values, dtype=np.float64).reshape(-1)
        room = self._room if out is None else out
        if given.shape[0] != self.sizes[0] or room.shape != (self.sizes[1],):
            raise StudyError(f"{self.sizes[0]} numbers go in and {self.sizes[1]} come out")
        return Step(self._native.step(given, room), room)

    @property
    def reason(self) -> str | None:
        """Why the last step did not converge."""
        return self._native.reason

    def reset(self) -> None:
        """The next step begins at rest."""
        self._native.reset()


def _names(things: Sequence[Any]) -> list[str]:
    return [thing.name if isinstance(thing, Handle) else str(thing) for thing in things]
