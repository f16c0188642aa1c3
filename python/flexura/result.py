"""Equilibria."""

from __future__ import annotations

import html
import json
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._references import Handle
from .errors import FlexuraError, StudyError
from .records import Array, Named, Record, equal

if TYPE_CHECKING:
    import pandas
    import pyvista
    import xarray
    from matplotlib.axes import Axes

    from .model import Model

#: Units of what beams have along them.
BEAM_UNITS = {
    "s": "m",
    "position": "m",
    "rotation": "",
    "force": "N",
    "moment": "N*m",
    "curvature": "1/m",
    "stretch": "",
    "stress": "Pa",
    "strain": "",
    "foundation": "N/m",
    "foundation_force": "N",
}


class Beam(Record):
    """A beam's state at its n samples, SI units and global axes.

    ``s`` (n,) undeformed arc length; ``position`` (n, 3); ``rotation`` (n, 4) as w, x, y, z; ``force`` and ``moment`` (n, 3) of
    the part beyond s on the part before it; ``curvature`` (n, 3) k1, k2, k3; ``stretch`` (n,); ``stress`` (n,) largest von Mises
    and ``strain`` (n,), where the section has a shape.
    """

    s: Array
    position: Array
    rotation: Array
    force: Array
    moment: Array
    curvature: Array
    stretch: Array
    stress: Array
    strain: Array


class Body(Record):
    """A body's pose: ``position`` (3,) and ``rotation`` (4,) as w, x, y, z."""

    position: Array
    rotation: Array


class Page:
    """The page of a result, for a notebook; ``html`` is its text."""

    def __init__(self, document: str, height: int = 520) -> None:
        self.html = _native.page(document)
        self.height = height

    def _repr_html_(self) -> str:
        source = html.escape(self.html, quote=True)
        return f'<iframe srcdoc="{source}" style="width:100%;height:{self.height}px;border:0"></iframe>'

    def save(self, path: str) -> None:
        """Writes it as a file that opens in a browser."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.html)


class Shown:
    """What results of all kinds have: a document, a page, how they ended."""

    _model: Model
    _text: str | None

    @property
    def model(self) -> Model:
        """The model with the values that it was solved with."""
        return self._model

    def to_json(self) -> str:
        """The result document, as the command writes it."""
        if self._text is None:
            raise FlexuraError("there is no document of where it broke off: it would hold numbers that are none")
        return self._text

    @cached_property
    def document(self) -> Record:
        """The result document: everything that is known of it."""
        return Record(json.loads(self._text) if self._text is not None else {})

    def page(self, height: int = 520) -> Page:
        """The page that shows it."""
        return Page(self.to_json(), height)


class Result(Shown):
    """An equilibrium, or how far the way to it went.

    Numbers are SI, axes global. Arrays are made when they are asked for, and kept.
    """

    def __init__(self, model: Model, native: _native.Solved | None, text: str | None = None) -> None:
        self._model = model
        self._native = native
        self._written = text

    # The document is written when it is wanted.
    @property
    def _text(self) -> str | None:  # type: ignore[override]
        if self._written is None and self._native is not None:
            self._written = self._native.document()
        return self._written

    def _solved(self) -> _native.Solved:
        """The native solution; solved again from here where it came from another process."""
        if self._native is None:
            self._native = self._model.solve()._native
            assert self._native is not None
        return self._native

    def _of(self, key: str) -> Any:
        return getattr(self._native, key) if self._native is not None else self.document.get(key)

    @property
    def status(self) -> str:
        """``converged``, or why not: ``stalled``, ``singular``, ``interrupted`` ..."""
        return str(self._of("status"))

    @property
    def reason(self) -> str | None:
        """Why it did not converge, and what to try."""
        reason: str | None = self._of("reason")
        return reason

    @property
    def converged(self) -> bool:
        """Is it an equilibrium under the full load?"""
        return self.status == "converged"

    @property
    def load_fraction(self) -> float:
        """Part of the full load that was reached."""
        fraction = self._of("load_fraction")
        return 1.0 if fraction is None else float(fraction)

    @property
    def warnings(self) -> list[str]:
        """What to know though it went well."""
        return list(self._of("warnings"))

    @property
    def energy(self) -> float:
        """Strain energy, J."""
        return float(self._of("energy"))

    @property
    def error_estimate(self) -> float:
        """Estimated largest relative error."""
        estimate = self._of("error_estimate")
        return float("nan") if estimate is None else float(estimate)

    @property
    def stable(self) -> bool | None:
        """Is it stable? None where that is not decided, as ``stability_reason`` says."""
        stable: bool | None = self._of("stable")
        return stable

    @property
    def unstable_directions(self) -> int | None:
        """How many directions are unstable; None where that is not decided."""
        count: int | None = self._of("unstable_directions")
        return count

    @property
    def stability_reason(self) -> str | None:
        """Why stability is not decided."""
        reason: str | None = self._of("stability_reason")
        return reason

    @cached_property
    def parameters(self) -> Mapping[str, float]:
        """Values of the parameters, SI, those that were found among them."""
        return self._native.parameters() if self._native is not None else dict(self.document["parameters"])

    @cached_property
    def outputs(self) -> Mapping[str, Any]:
        """Values of the outputs: numbers, or arrays (3,). Those without a value are missing; see ``output_reasons``."""
        found: Mapping[str, Any] = self._native.outputs() if self._native is not None else self.document["outputs"]
        return Named("output", [name for name in found if found[name] is not None], lambda name: found[name])

    @property
    def units(self) -> dict[str, str]:
        """SI units of the outputs."""
        return self._model.outputs

    @property
    def output_reasons(self) -> dict[str, str]:
        """Outputs without a value, and why."""
        if self._native is not None:
            return dict(self._native.output_reasons())
        return dict(self.document.get("output_reasons", {}))

    @cached_property
    def beams(self) -> Mapping[str, Beam]:
        """The beams by name."""
        if self._native is None:
            return Named("beam", list(self.document["beams"]), lambda name: Beam(self.document["beams"]._entries[name]))
        native = self._native

        def make(name: str) -> Beam:
            entries = native.beam(name)
            assert entries is not None
            return Beam(entries)

        return Named("beam", self._model._described["beams"], make)

    def _table(self, key: str) -> Named[Any]:
        entries = self.document[key]
        of = Body if key == "bodies" else Record
        return Named(key, list(entries), lambda name: of(entries._entries[name]))

    @cached_property
    def bodies(self) -> Mapping[str, Body]:
        """The bodies by name."""
        return self._table("bodies")

    @cached_property
    def joints(self) -> Mapping[str, Record]:
        """The joints by name: ``coordinates``, ``efforts``, ``force``, ``moment``."""
        return self._table("joints")

    @cached_property
    def springs(self) -> Mapping[str, Record]:
        """The springs by name: ``length``, ``tension``, ``strain``, ``slack``."""
        return self._table("springs")

    @cached_property
    def couplings(self) -> Mapping[str, Record]:
        """The couplings by name: ``multiplier``."""
        return self._table("couplings")

    @cached_property
    def cables(self) -> Mapping[str, Record]:
        """The cables by name: ``length``, ``tension``, ``course``."""
        return self._table("cables")

    @cached_property
    def tubes(self) -> Mapping[str, Record]:
        """Sets of concentric tubes by name."""
        return self._table("tubes")

    @cached_property
    def compliance(self) -> Mapping[str, Array]:
        """Compliances (6, 6) of the places that were asked for: (x, y, z, rx, ry, rz) by (fx, fy, fz, mx, my, mz)."""
        found: Mapping[str, Array] = self.document.get("compliance") or {}
        return found

    # Derivatives.

    def jacobian(self, outputs: Iterable[Any] | None = None, parameters: Iterable[Any] | None = None) -> Array:
        """d outputs / d parameters at the equilibrium, SI: one row for a number, three for a vector, in that order.

        Of an inverse problem the unknown parameters move so that the targets are kept; ``"parameter.NAME"`` as an output is
        how one of them moves.

        Raises:
            StudyError: an unknown name, or a derivative that does not exist.
        """
        lines, columns = self._derivatives(parameters)
        wanted = list(lines) if outputs is None else [_name(output) for output in outputs]
        rows: list[list[float]] = []
        for output in wanted:
            if output not in lines:
                raise StudyError.at(f"output.{output}", f"there is no output `{output}`", hint=f"there are {', '.join(lines)}")
            rows += lines[output]
        matrix = np.array(rows, dtype=float).reshape(len(rows), len(columns))
        if np.isnan(matrix).any():
            row, column = np.argwhere(np.isnan(matrix))[0]
            raise StudyError.at(f"parameter.{columns[column]}", f"row {row} of the Jacobian has no derivative by it")
        return matrix

    def sensitivity(self, output: Any, parameter: Any) -> float | Array:
        """d output / d parameter: a number, or (3,) of a vector."""
        column = self.jacobian([output], [parameter])[:, 0]
        return float(column[0]) if len(column) == 1 else column

    def vjp(self, cotangents: Mapping[Any, Any], parameters: Iterable[Any] | None = None) -> dict[str, float]:
        """Derivatives of Σ cotangent · output by the parameters."""
        names = self._given_parameters() if parameters is None else [_name(parameter) for parameter in parameters]
        matrix = self.jacobian(cotangents, names)
        weights = np.concatenate([np.atleast_1d(np.asarray(weight, dtype=float)) for weight in cotangents.values()])
        if len(weights) != len(matrix):
            raise StudyError(f"{len(weights)} cotangents for {len(matrix)} components of outputs")
        return dict(zip(names, (weights @ matrix).tolist(), strict=True))

    def _given_parameters(self) -> list[str]:
        unknowns = set(self._model.unknowns)
        return [name for name in self._model.parameters if name not in unknowns]

    def _derivatives(self, parameters: Iterable[Any] | None) -> tuple[dict[str, list[list[float]]], list[str]]:
        names = self._given_parameters() if parameters is None else [_name(parameter) for parameter in parameters]
        all_names = list(self._model.parameters)
        for name in names:
            if name not in all_names:
                raise StudyError.at(f"parameter.{name}", f"there is no parameter `{name}`", hint=f"there are {', '.join(all_names)}")
        if not self.converged:
            raise StudyError("no derivatives: this is no equilibrium")
        lines, columns, left_out = self._solved().derivatives([all_names.index(name) for name in names])
        for name, why in left_out:
            raise StudyError.at(f"parameter.{name}", f"no derivatives: {why}")
        missing = [name for name in names if name not in columns]
        if missing:
            raise StudyError.at(f"parameter.{missing[0]}", "is an unknown, which a solve finds; there is no derivative by it")
        return dict(lines), columns

    # Tables and pictures.

    def to_pandas(self) -> pandas.DataFrame:
        """The samples of all beams, a row each; units stand in ``attrs``."""
        import pandas

        tables = []
        for name, beam in self.beams.items():
            columns: dict[str, Any] = {"beam": name, "s": beam.s}
            for key, letters in (("position", "xyz"), ("rotation", "wxyz"), ("force", "xyz"), ("moment", "xyz"), ("curvature", "123")):
                columns |= {f"{key}.{letter}": beam[key][:, i] for i, letter in enumerate(letters)}
            columns |= {key: beam[key] for key in ("stretch", "stress", "strain") if key in beam}
            tables.append(pandas.DataFrame(columns))
        table = pandas.concat(tables, ignore_index=True) if tables else pandas.DataFrame()
        table.attrs["units"] = {column: BEAM_UNITS.get(column.partition(".")[0], "") for column in table.columns}
        return table

    def to_xarray(self) -> xarray.Dataset:
        """Outputs, parameters and the beams along their samples; units stand in ``attrs``."""
        import xarray

        data: dict[str, Any] = {}
        for name, value in self.outputs.items():
            dims = ("component",) if np.ndim(value) else ()
            data[name] = (dims, value, {"units": self.units[name]})
        coordinates: dict[str, Any] = {"component": ["x", "y", "z"], "quaternion": ["w", "x", "y", "z"]}
        for name, beam in self.beams.items():
            along = f"{name}.s"
            coordinates[along] = ((along,), beam.s, {"units": "m"})
            for key in beam:
                value = beam[key]
                if key == "s" or value is None:
                    continue
                inner = {3: ("component",), 4: ("quaternion",)}.get(value.shape[-1], ()) if value.ndim == 2 else ()
                outer = (along,) if key != "foundation_force" else ("component",)
                data[f"{name}.{key}"] = (outer + inner, value, {"units": BEAM_UNITS.get(key, "")})
        for name, (_, unit) in self._model.parameters.items():
            coordinates[f"parameter.{name}"] = ((), self.parameters[name], {"units": unit})
        attrs = {"model": self._model.name, "status": self.status, "energy": self.energy, "key": self._model.key}
        return xarray.Dataset(data, coordinates, attrs)

    def to_vtp(self) -> str:
        """The shape as a file for VTK and ParaView."""
        return self._solved().vtp()

    def to_pyvista(self) -> pyvista.PolyData:
        """The shape as a mesh with its fields."""
        import tempfile
        from pathlib import Path

        import pyvista

        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "model.vtp"
            path.write_text(self.to_vtp(), encoding="utf-8")
            return pyvista.PolyData(str(path))

    def to_svg(self) -> str:
        """The shape as a picture."""
        return self._solved().svg()

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """The deformed shape by matplotlib: in the plane where it lies in one, else in space."""
        from .plotting import plot_shape

        return plot_shape(self, axes, **style)

    def difference(self, other: Result) -> dict[str, float]:
        """The largest relative difference of each output, of the beams' positions and of the bodies' poses."""
        differences: dict[str, float] = {}

        def put(name: str, a: Any, b: Any) -> None:
            a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
            scale = max(float(np.abs(a).max(initial=0.0)), float(np.abs(b).max(initial=0.0)))
            if a.shape != b.shape:
                differences[name] = float("inf")
            elif scale > 0.0:
                differences[name] = float(np.abs(a - b).max()) / scale
            else:
                differences[name] = 0.0

        for name in self.outputs:
            put(f"output.{name}", self.outputs[name], other.outputs[name] if name in other.outputs else np.inf)
        for name in self.beams:
            put(f"beam.{name}", self.beams[name].position, other.beams[name].position)
        for name in self.bodies:
            put(f"body.{name}", self.bodies[name].position, other.bodies[name].position)
        return differences

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Result):
            return NotImplemented
        return self.model == other.model and equal(_stated(self), _stated(other))

    __hash__ = None  # type: ignore[assignment]

    def __getstate__(self) -> dict[str, Any]:
        state = {key: self._of(key) for key in ("status", "reason", "warnings", "load_fraction")}
        return {"model": self._model, "text": self._text, "state": state}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(state["model"], None, state["text"])  # type: ignore[misc]
        if state["text"] is None:
            # What broke off where nothing can be evaluated leaves only how it ended.
            empty: dict[str, Any] = dict.fromkeys(("outputs", "beams", "bodies", "joints", "springs", "couplings", "cables", "tubes"), {})
            self.__dict__["document"] = Record({**empty, **state["state"], "energy": float("nan"), "parameters": {}})

    def __repr__(self) -> str:
        stable = {True: ", stable", False: ", unstable", None: ""}[self.stable]
        lines = [f"<flexura.Result {self._model.name!r}: {self.status}{stable}"]
        lines += [f"  {name} = {_valued(value, self.units.get(name, ''))}" for name, value in self.outputs.items()]
        return "\n".join(lines) + ">"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{html.escape(name)}</td><td>{html.escape(_valued(value, self.units.get(name, '')))}</td></tr>"
            for name, value in self.outputs.items()
        )
        title = f"<b>{html.escape(self._model.name)}</b>: {self.status}"
        return f"<div>{title}<table>{rows}</table>{self.to_svg()}</div>"


def _name(what: Any) -> str:
    return what.name if isinstance(what, Handle) else str(what)


def _stated(result: Result) -> dict[str, Any]:
    """What two results must share to be the same; not how much work they were."""
    skipped = {"work", "newton_steps", "scene", "flexura", "warnings"}
    return {key: value for key, value in result.document.items() if key not in skipped}


def _valued(value: Any, unit: str) -> str:
    if np.ndim(value):
        return f"[{', '.join(f'{float(item):.6g}' for item in value)}] {unit}".rstrip()
    return f"{float(value):.6g} {unit}".rstrip()
