"""Linear models about an equilibrium, for control."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .records import Array

if TYPE_CHECKING:
    from .model import Model


class StateSpace:
    """x' = A x + B u, y = C x + D u about an equilibrium, SI units.

    States are modal coordinates, each with a generalised mass of 1 kg, then their rates; outputs are changes from the equilibrium.
    """

    def __init__(self, model: Model, text: str, mat: bytes, picture: str) -> None:
        self._model = model
        self._mat = mat
        self._picture = picture
        self.document: dict[str, Any] = json.loads(text)
        self.A = self._matrix("a", "states", "states")
        self.B = self._matrix("b", "states", "inputs")
        self.C = self._matrix("c", "outputs", "states")
        self.D = self._matrix("d", "outputs", "inputs")

    def _matrix(self, key: str, rows: str, columns: str) -> Array:
        shape = (len(self.document[rows]), len(self.document[columns]))
        return np.array(self.document[key], dtype=float).reshape(shape)

    @property
    def model(self) -> Model:
        """The model, with the values of the equilibrium."""
        return self._model

    @property
    def inputs(self) -> list[str]:
        """Names of the inputs."""
        return [str(signal["name"]) for signal in self.document["inputs"]]

    @property
    def outputs(self) -> list[str]:
        """Names of the outputs."""
        return [str(signal["name"]) for signal in self.document["outputs"]]

    @property
    def states(self) -> list[str]:
        """Names of the states."""
        return [str(signal["name"]) for signal in self.document["states"]]

    @property
    def units(self) -> dict[str, str]:
        """SI units of states, inputs and outputs."""
        return {str(own["name"]): str(own["unit"]) for part in ("states", "inputs", "outputs") for own in self.document[part]}

    @property
    def response_error(self) -> float | None:
        """Largest difference from the undamped response of the whole mechanism up to the last mode, beside the response's size."""
        error = self.document["response_error"]
        return None if error is None else float(error)

    @property
    def residual_vectors(self) -> int:
        """How many residual vectors there are for each input."""
        return int(self.document["residual_vectors"])

    def response(self, omega: Any) -> Array:
        """C (iω - A)⁻¹ B + D at circular frequencies (rad/s): (n, outputs, inputs), complex."""
        rates = np.atleast_1d(np.asarray(omega, dtype=float))
        identity = np.eye(len(self.A))
        return np.array([self.C @ np.linalg.solve(1j * rate * identity - self.A, self.B) + self.D for rate in rates])

    def to_scipy(self) -> Any:
        """A ``scipy.signal.StateSpace``."""
        from scipy.signal import StateSpace as Linear

        return Linear(self.A, self.B, self.C, self.D)

    def to_control(self) -> Any:
        """A ``control.StateSpace`` of python-control, with the names, in which it wants ``_`` for every dot."""
        import control

        states, inputs, outputs = ([name.replace(".", "_") for name in names] for names in (self.states, self.inputs, self.outputs))
        return control.ss(self.A, self.B, self.C, self.D, states=states, inputs=inputs, outputs=outputs)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes ``.json``, ``.mat`` (MATLAB, ``scipy.io.loadmat``) or the frequency response as ``.svg``."""
        path = Path(path)
        match path.suffix:
            case ".json":
                path.write_text(json.dumps(self.document, indent=2) + "\n", encoding="utf-8")
            case ".mat":
                path.write_bytes(self._mat)
            case ".svg":
                path.write_text(self._picture, encoding="utf-8")
            case other:
                raise ValueError(f"cannot write {other or 'a file without an ending'}: write .json, .mat or .svg")

    def _repr_html_(self) -> str:
        return f"<div>{self._picture}</div>"

    def __repr__(self) -> str:
        size = f"{len(self.inputs)} inputs, {len(self.states)} states, {len(self.outputs)} outputs"
        return f"<flexura.StateSpace {self.model.name!r}: {size}>"
