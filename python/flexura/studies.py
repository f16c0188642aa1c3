"""Paths of equilibria, critical loads, motions in time."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from .records import Array, Record
from .result import Shown

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

    from .model import Model


class Study(Shown):
    """What a study came to."""

    def __init__(self, model: Model, native: _native.Study) -> None:
        self._model = model
        self._text = native.document
        self.status = native.status
        self.reason = native.reason
        self.files = dict(native.files)

    @property
    def converged(self) -> bool:
        """Did it do what was asked?"""
        return self.status == "converged"

    @property
    def warnings(self) -> list[str]:
        """What to know though it went well."""
        return list(self.document.get("warnings", []))

    def __getstate__(self) -> dict[str, Any]:
        return {key: value for key, value in self.__dict__.items() if key in {"_model", "_text", "status", "reason", "files"}}

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and (other._model, other._text) == (self._model, self._text)

    __hash__ = None  # type: ignore[assignment]

    def _picture(self) -> str:
        return next((text for name, text in self.files.items() if name.endswith(".svg")), "")

    def _repr_html_(self) -> str:
        return f"<div>{self._picture()}</div>"


class Branch:
    """A smooth curve of equilibria: every list has one entry for each of its n points."""

    def __init__(self, entries: Record, parameter: str) -> None:
        self.points: Sequence[Record] = entries["points"]
        self.record = entries
        self._parameter = parameter

    @cached_property
    def parameter(self) -> Array:
        """Values of the parameter (n,), SI."""
        return np.array([point["parameter"] for point in self.points], dtype=float)

    @cached_property
    def kinds(self) -> list[str]:
        """``regular``, ``fold``, ``branch``, ``event`` or ``end``."""
        return [point["kind"] for point in self.points]

    @cached_property
    def stable(self) -> list[bool | None]:
        """Is each stable? None where that is not decided."""
        return [point["stable"] for point in self.points]

    def output(self, name: Any) -> Array:
        """An output along it: (n,), or (n, 3) of a vector; NaN where it has no value."""
        values = [point["outputs"].get(str(name)) for point in self.points]
        known = next((value for value in values if value is not None), np.nan)
        blank = np.full(np.shape(known), np.nan)
        return np.array([blank if value is None else value for value in values], dtype=float)

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        return f"<{len(self)} points, {self._parameter} from {self.parameter[0]:.6g} to {self.parameter[-1]:.6g}>"


class Path(Study):
    """Equilibria as one parameter changes, in one branch or several."""

    @property
    def parameter(self) -> str:
        """Name of the parameter."""
        return str(self.document["parameter"])

    @cached_property
    def branches(self) -> list[Branch]:
        """The branches, the one that starts at rest first."""
        return [Branch(entries, self.parameter) for entries in self.document["branches"]]

    def _special(self, kind: str) -> list[Record]:
        return [point for branch in self.branches for point in branch.points if point["kind"] == kind]

    @property
    def folds(self) -> list[Record]:
        """Points at which the parameter turns back, to the solver's tolerance: ``.parameter``, ``.outputs``."""
        return self._special("fold")

    @property
    def branch_points(self) -> list[Record]:
        """Points at which branches cross."""
        return self._special("branch")

    @property
    def events(self) -> list[Record]:
        """Points at which something happens that was asked for."""
        return self._special("event")

    @property
    def critical(self) -> Record | None:
        """A critical point followed in a second parameter, where that was asked for."""
        found: Record | None = self.document.get("critical")
        return found

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each point of each branch; units stand in ``attrs``."""
        import pandas

        rows = []
        for number, branch in enumerate(self.branches):
            for i, point in enumerate(branch.points):
                row: dict[str, Any] = {"branch": number, "point": i, "kind": point["kind"], self.parameter: point["parameter"]}
                for name, value in point["outputs"].items():
                    row |= _components(name, value)
                row |= {key: point.get(key) for key in ("stable", "unstable_directions", "error_estimate")}
                rows.append(row)
        table = pandas.DataFrame(rows)
        units = {self.parameter: self.model.parameters[self.parameter].unit}
        table.attrs["units"] = {**units, **self.model.outputs}
        return table

    def plot(self, output: Any = None, axes: Axes | None = None, **style: Any) -> Axes:
        """An output over the parameter: stable points solid, unstable ones dashed, undecided ones dotted."""
        from .plotting import plot_path

        return plot_path(self, output, axes, **style)

    def __repr__(self) -> str:
        counted = f"{len(self.branches)} branches, {sum(map(len, self.branches))} points, {len(self.folds)} folds"
        return f"<flexura.Path {self.model.name!r} in {self.parameter}: {self.status}, {counted}>"


def _components(name: str, value: Any) -> dict[str, Any]:
    if np.ndim(value) == 0:
        return {name: np.nan if value is None else value}
    return {f"{name}.{letter}": value[i] for i, letter in enumerate("xyz")}


class Buckling(Study):
    """Critical loads of the problem linearised about an equilibrium."""

    @property
    def modes(self) -> list[Record]:
        """The modes, nearest first: ``value``, ``error_estimate`` and shapes."""
        return list(self.document["modes"])

    @cached_property
    def values(self) -> Array:
        """The critical values: of the parameter (SI), or factors of all loads."""
        return np.array([mode["value"] for mode in self.modes], dtype=float)

    def __repr__(self) -> str:
        values = ", ".join(f"{value:.6g}" for value in self.values)
        return f"<flexura.Buckling {self.model.name!r}: {self.status}, critical at {values}>"


class Optimum(Study):
    """The best design that was found, and the searches that led there."""

    @property
    def found(self) -> Record | None:
        """The best design: ``parameters``, ``objective``, ``active``, ``multipliers``, ``constraints``; where none meets all
        constraints, the one that misses them least."""
        best: Record | None = self.document["optimum"]
        return best

    @property
    def parameters(self) -> dict[str, float]:
        """The values of the parameters that were varied, SI."""
        return {} if self.found is None else dict(self.found["parameters"])

    @property
    def objective(self) -> float:
        """The least or greatest value of the objective, SI."""
        return float("nan") if self.found is None else float(self.found["objective"])

    @property
    def active(self) -> list[str]:
        """The bounds that hold the optimum back."""
        return [] if self.found is None else list(self.found["active"])

    @property
    def starts(self) -> list[Record]:
        """Each search: ``from``, ``status``, ``end`` and ``history``."""
        return list(self.document["starts"])

    @property
    def front(self) -> list[Record]:
        """The compromises between two objectives, best of the first one first."""
        return list(self.document.get("front", []))

    @property
    def left_out(self) -> list[Record]:
        """Designs without values, with the reason: the first few."""
        return list(self.document["left_out"])

    def best_model(self) -> Model:
        """The model with the values of the best design."""
        return self.model.with_values(self.parameters)

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each design on the way of each search."""
        import io

        import pandas

        return pandas.read_csv(io.StringIO(self.files["history.csv"]))

    def __repr__(self) -> str:
        values = ", ".join(f"{name} = {value:.6g}" for name, value in self.parameters.items())
        return f"<flexura.Optimum {self.model.name!r}: {self.status}, {self.objective:.6g} at {values}>"


class Modes(Study):
    """Natural modes about an equilibrium, or about the state at rest."""

    @property
    def modes(self) -> list[Record]:
        """The modes, lowest first: ``kind``, ``frequency_hz``, ``rate``, ``growth``, masses and shapes."""
        return list(self.document["modes"])

    @cached_property
    def frequencies(self) -> Array:
        """Natural frequencies, Hz: zero of motions without stiffness, not a number of modes that grow without swinging."""
        return np.array([np.nan if (own := mode["frequency_hz"]) is None else own for mode in self.modes], dtype=float)

    @cached_property
    def growth(self) -> Array:
        """By which rate each mode grows, 1/s."""
        return np.array([mode["growth"] for mode in self.modes], dtype=float)

    @property
    def damping_ratios(self) -> Array:
        """Damping ratios (n,); zero where nothing damps."""
        return np.array([mode.get("damping_ratio", 0.0) for mode in self.modes], dtype=float)

    @cached_property
    def effective_masses(self) -> Array:
        """Effective masses (n, 6): of shifts along x, y, z (kg) and of turnings about them (kg·m²)."""
        none = [np.nan] * 6
        masses = [none if (own := mode["effective_mass"]) is None else own for mode in self.modes]
        return np.array(masses, dtype=float).reshape(-1, 6)

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each mode."""
        import io

        import pandas

        return pandas.read_csv(io.StringIO(self.files["modes.csv"]))

    def __repr__(self) -> str:
        values = ", ".join(f"{value:.6g}" for value in self.frequencies)
        return f"<flexura.Modes {self.model.name!r}: {self.status}, {values} Hz>"


class Frequencies(Study):
    """Natural frequencies along a path of equilibria, each followed by its shape."""

    @property
    def parameter(self) -> str:
        """The parameter that changes."""
        return str(self.document["parameter"])

    def values(self, branch: int = 0) -> Array:
        """The parameter at the points of a branch (n,)."""
        return np.array([point["parameter"] for point in self.document["branches"][branch]["points"]], dtype=float)

    def frequencies(self, branch: int = 0) -> Array:
        """Frequencies (n, modes), Hz; not a number where a mode is not among the lowest, or where the point is critical."""
        return self._each(branch, "rate") / (2 * np.pi)

    def growth(self, branch: int = 0) -> Array:
        """By which rate modes grow (n, modes), 1/s."""
        return self._each(branch, "growth")

    def onsets(self, branch: int = 0) -> list[dict[str, Any]]:
        """Where along a branch flutter or divergence sets in or ends: ``parameter``, ``kind``, ``begins``, ``rate`` (rad/s)."""
        return list(self.document["branches"][branch]["onsets"])

    def _each(self, branch: int, key: str) -> Array:
        points = self.document["branches"][branch]["points"]
        table = np.full((len(points), max((len(point["modes"]) for point in points), default=0)), np.nan)
        for i, point in enumerate(points):
            for k, mode in enumerate(point["modes"]):
                table[i, k] = np.nan if mode is None else mode[key]
        return table

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each point of each branch."""
        import io

        import pandas

        return pandas.read_csv(io.StringIO(self.files["frequencies.csv"]))

    def __repr__(self) -> str:
        points = sum(len(branch["points"]) for branch in self.document["branches"])
        return f"<flexura.Frequencies {self.model.name!r} in {self.parameter}: {self.status}, {points} points>"


class Motion(Study):
    """A motion in time, and the forces that it takes."""

    @cached_property
    def times(self) -> Array:
        """The times (n,), s. Where the acceleration jumps there are two of one time."""
        return np.asarray(self.document["times"], dtype=float)

    @property
    def outputs(self) -> Record:
        """Every output over time: (n,) or (n, 3)."""
        return Record(self.document["outputs"])

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each time."""
        import io

        import pandas

        return pandas.read_csv(io.StringIO(self.files["motion.csv"]))

    def __repr__(self) -> str:
        return f"<flexura.Motion {self.model.name!r}: {self.status}, {len(self.times)} times to {self.times[-1]:.6g} s>"
