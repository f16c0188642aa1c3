"""Models: read from a file or built by keywords, checked and solved."""

from __future__ import annotations

import copy
import errno
import hashlib
import json
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from keyword import iskeyword
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Self, overload

from . import _native, _values
from ._references import Handle, text_of
from .control import StateSpace
from .errors import ConvergenceError, ModelError, StudyError
from .result import Result
from .fitting import Fit, ResponseFormula
from .studies import Buckling, Frequencies, Modes, Motion, Optimum, Path, Study

if TYPE_CHECKING:
    from ._tables import Tables
    from .stepper import Stepper
    from .sweep import Explanation, Sweep
else:

    class Tables:
        """The tables of the model file as methods; ``_tables.pyi`` lists them with their keys."""


#: Shapes between those states of a path that are kept whole: sections along each beam.
_SHAPES = 17


class Quantity(NamedTuple):
    """A parameter or an output: its value in SI units where it has one, and that unit."""

    value: float | None
    unit: str


class Check(NamedTuple):
    """Unknowns against equations."""

    unknowns: dict[str, int]
    equations: dict[str, int]
    warnings: tuple[str, ...]

    @property
    def is_square(self) -> bool:
        """Are there as many equations as unknowns?"""
        return sum(self.unknowns.values()) == sum(self.equations.values())

    def __str__(self) -> str:
        lines = [f"{sum(self.unknowns.values())} unknowns, {sum(self.equations.values())} equations"]
        for title, items in (("unknowns", self.unknowns), ("equations", self.equations)):
            lines += ["", title, *(f"  {count:4d}  {what}" for what, count in items.items())]
        lines += [f"\nwarning: {warning}" for warning in self.warnings]
        return "\n".join(lines)


@cache
def _format() -> Mapping[str, Any]:
    """What the model file may hold, by its schema."""
    properties: Mapping[str, Any] = json.loads(_native.schema())["properties"]
    return properties


def _named_tables() -> Mapping[str, bool]:
    """The tables whose entries have names: do the entries have keys (or are they values)?"""
    tables = {}
    for key, schema in _format().items():
        for part in schema.get("allOf", [schema]):
            inner = part.get("additionalProperties")
            if isinstance(inner, dict):
                tables[key] = "properties" in inner or "oneOf" in inner
    return tables

_KINDS: dict[str, type[Study]] = {
    "trace": Path,
    "buckle": Buckling,
    "modes": Modes,
    "frequencies": Frequencies,
    "inverse_dynamics": Motion,
    "optimise": Optimum,
    "fit": Fit,
    "formula": ResponseFormula,
}


class Model(Tables):
    """A compliant mechanism.

    ``Model("name")`` begins an empty one. Every table of the model file is a method: ``m.beam("a", length="100 mm", ...)`` is the
    table ``[beam.a]``, ``m.parameter("travel", "20 mm")`` a line of ``[parameter]``; what is not a named table is a keyword here,
    as in ``Model("name", gravity=[0, 0, "-9.81 m/s^2"])``. Values are numbers in SI units, texts with a unit, quantities of
    pint, formulas, lists and dicts.

    A model is checked when it is first used; what is wrong then raises :class:`ModelError` with the path of the key.
    """

    def __init__(self, name: str | None = None, /, **keys: Any) -> None:
        self._tree: dict[str, Any] | None = {"format": 1}
        self._text: str | None = None
        self._file = ""
        self._values: dict[str, float | str] = {}
        self._cached: _native.Mechanism | None = None
        self._description: dict[str, Any] | None = None
        if name is not None:
            self._tree["name"] = _values.plain(name, "name")
        self._tree.update(_values.table(keys, ""))

    @classmethod
    def from_dict(cls, tree: Mapping[str, Any], folder: str | os.PathLike[str] = "") -> Self:
        """A model from the tables of a model file as nested dicts; files that it names are looked for in ``folder``."""
        model = cls()
        model._tree = _values.table(tree, "")
        model._file = os.path.join(folder, "model") if folder else ""
        return model

    def to_dict(self) -> dict[str, Any]:
        """The tables of the model file as nested dicts."""
        return copy.deepcopy(self._edited(keep=True))

    def to_toml(self) -> str:
        """The text of a model file that makes the same model. One that was read and not changed is given as it was."""
        return self._text if self._text is not None else _values.to_toml(self._edited(keep=True))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the model file."""
        FilePath(path).write_text(self.to_toml(), encoding="utf-8")

    # Building.

    def __getattr__(self, table: str) -> Callable[..., Handle]:
        if table.startswith("_") or table not in _named_tables():
            raise AttributeError(f"a model has no attribute {table!r}")

        def add(name: str, value: Any = None, /, **keys: Any) -> Handle:
            return self.add(table, name, value, **keys)

        add.__name__ = table
        add.__doc__ = _format()[table].get("description")
        return add

    def __dir__(self) -> Iterable[str]:
        return [*super().__dir__(), *_named_tables()]

    def add(self, table: str, name: str, value: Any = None, /, **keys: Any) -> Handle:
        """An entry of a table, which may hold a value (a parameter, an output) or keys (a beam, a joint).

        A key that is a word of Python has a ``_`` behind it: ``from_``.
        """
        keys = {key[:-1] if iskeyword(key[:-1]) and key.endswith("_") else key: item for key, item in keys.items()}
        name, path = str(text_of(name) if not isinstance(name, str) else name), f"{table}.{name}"
        if value is not None and keys:
            raise ModelError.at(path, "has a value and keys", hint=f"write m.{table}(name, value) or m.{table}(name, key=...)")
        if value is None and not keys and not _named_tables().get(table, True):
            raise ModelError.at(path, "has no value", hint=f'write m.{table}("{name}", value)')
        entries = self._edited().setdefault(table, {})
        if name in entries:
            raise ModelError.at(path, f"there is already {path}", hint="take another name, or change it by m.set(path, value)")
        entries[name] = _values.plain(value, path) if value is not None else _values.table(keys, path)
        return Handle(table, name)

    def set(self, path: str, value: Any) -> None:
        """Changes what stands at a path: ``m.set("beam.a.length", "120 mm")``; None takes it away."""
        node: Any = self._edited()
        *way, last = path.split(".")
        for i, key in enumerate(way):
            node = node.setdefault(key, {})
            if not isinstance(node, dict):
                raise ModelError.at(".".join(way[: i + 1]), "is no table, so nothing stands below it")
        if value is None:
            node.pop(last, None)
        else:
            node[last] = _values.plain(value, path)

    def handle(self, path: str) -> Handle:
        """What has a path such as ``body.stage``, for formulas and references."""
        table, _, name = path.partition(".")
        if name not in self._edited(keep=True).get(table, {}):
            raise ModelError.at(path, f"there is no {table} `{name}`")
        return Handle(table, name)

    def with_values(self, parameters: Mapping[str, Any] | None = None, /, **values: Any) -> Self:
        """The same model with other values of some parameters."""
        other = self._copy()
        other._values.update(self._given(parameters, values))
        return other

    def _edited(self, keep: bool = False) -> dict[str, Any]:
        """The tree; unless it is kept, the text no longer counts."""
        if self._tree is None:
            assert self._text is not None
            self._tree = _native.tree(self._text)
        if not keep:
            self._text = self._cached = self._description = None
        return self._tree

    def _copy(self) -> Self:
        other = copy.copy(self)
        other._tree = copy.deepcopy(self._tree)
        other._values = dict(self._values)
        return other

    # What it is.

    @property
    def _mechanism(self) -> _native.Mechanism:
        if self._cached is None:
            lines = self._text is not None
            self._cached = _native.Mechanism(self.to_toml(), self._file or "model", lines)
        return self._cached

    @property
    def _described(self) -> dict[str, Any]:
        if self._description is None:
            self._description = self._mechanism.describe()
        return self._description

    @property
    def name(self) -> str:
        """Its title."""
        return str(self._edited(keep=True).get("name", ""))

    @property
    def parameters(self) -> dict[str, Quantity]:
        """The parameters, as the file has them; given values stand in ``values``."""
        return {name: Quantity(value, unit) for name, value, unit in self._described["parameters"]}

    @property
    def values(self) -> dict[str, float | str]:
        """Values of parameters that stand in place of the file's."""
        return dict(self._values)

    @property
    def outputs(self) -> dict[str, str]:
        """The outputs with their SI units."""
        return {name: unit for name, unit, _ in self._described["outputs"]}

    @property
    def unknowns(self) -> list[str]:
        """Parameters that a solve finds."""
        return list(self._described["unknowns"])

    @property
    def targets(self) -> dict[str, float]:
        """What an inverse problem wants, SI."""
        return dict(self._described["targets"])

    @property
    def studies(self) -> dict[str, str]:
        """The studies of the file with their kinds."""
        return dict(self._described["studies"])

    @property
    def warnings(self) -> list[str]:
        """What looks unintended though the model can be made."""
        return [str(ModelError.of([problem])) for problem in self._mechanism.warnings()]

    def check(self, parameters: Mapping[str, Any] | None = None, /, **values: Any) -> Check:
        """Counts unknowns against equations.

        Raises:
            ModelError: something is loose, held twice, or no sound number.
        """
        unknowns, equations, warnings = self._mechanism.check(self._all(parameters, values))
        return Check(dict(unknowns), dict(equations), (*self.warnings, *warnings))

    @property
    def key(self) -> str:
        """A hash of the model with its values; equal models have equal keys."""
        canonical = json.dumps([self._edited(keep=True), sorted(self._values.items())], sort_keys=False)
        return hashlib.sha256(canonical.encode()).hexdigest()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Model):
            return NotImplemented
        return self._edited(keep=True) == other._edited(keep=True) and self._values == other._values

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        tree = self._edited(keep=True)
        kinds = ("beam", "body", "joint", "spring", "cable", "tubes", "load", "parameter", "output", "study")
        counts = [f"{len(tree[kind])} {kind}" for kind in kinds if isinstance(tree.get(kind), dict)]
        return f"<flexura.Model {self.name!r}: {', '.join(counts) or 'empty'}>"

    def __getstate__(self) -> dict[str, Any]:
        return {"text": self._text, "tree": None if self._text else self._tree, "file": self._file, "values": self._values}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__()  # type: ignore[misc]
        self._text, self._tree = state["text"], state["tree"]
        self._file, self._values = state["file"], state["values"]

    # Studies.

    def _given(self, parameters: Mapping[str, Any] | None, values: Mapping[str, Any]) -> dict[str, float | str]:
        both = {**(parameters or {}), **values}
        return {str(name): _values.parameter(value, f"parameter.{name}") for name, value in both.items()}

    def _all(self, parameters: Mapping[str, Any] | None, values: Mapping[str, Any]) -> list[tuple[str, float | str]]:
        if not (parameters or values):
            return list(self._values.items())
        return list({**self._values, **self._given(parameters, values)}.items())

    def solve(
        self,
        parameters: Mapping[str, Any] | None = None,
        /,
        *,
        tolerance: float = 1e-8,
        samples: int = 101,
        sensitivities: bool = False,
        compliances: Sequence[Any] = (),
        start: Result | None = None,
        check: bool = True,
        **values: Any,
    ) -> Result:
        """The equilibrium reached from rest; of an inverse problem the unknown parameters too.

        Args:
            parameters: values of parameters by name, as further keywords are; for names that are keywords here.
            tolerance: wanted accuracy, relative to the beam's length, 1, EI/L² and EI/L.
            samples: samples along each beam, ends included.
            sensitivities: derivatives of all outputs by all parameters, for ``Result.document``.
            compliances: places (``"body.stage"``, ``"beam.a.end"``) whose compliance is wanted.
            start: an earlier result, of this or a neighbouring model, to start from in place of rest.
            check: raise where it did not converge.

        Raises:
            ModelError: the model or a value is wrong.
            ConvergenceError: no equilibrium was reached; ``.result`` is how far it came.
        """
        places = [place.path if isinstance(place, Handle) else str(place) for place in compliances]
        native = None if start is None else start._solved()
        solved = self._mechanism.solve(self._all(parameters, values), tolerance, samples, sensitivities, places, native)
        given = self.with_values(parameters, **values) if parameters or values else self
        result = Result(given, solved)
        if check and solved.status != "converged":
            raise ConvergenceError(f"{self.name or 'the model'}: {solved.status}: {solved.reason}", result)
        return result

    def equilibria(
        self,
        parameters: Mapping[str, Any] | None = None,
        /,
        *,
        guesses: int = 20,
        seed: int = 0,
        tolerance: float = 1e-8,
        **values: Any,
    ) -> list[Result]:
        """All equilibria that are found under the full load from that many random states, by their energy."""
        found = self._mechanism.equilibria(self._all(parameters, values), tolerance, guesses, seed)
        given = self.with_values(parameters, **values)
        return [Result(given, solved) for solved in found]

    def run(
        self,
        study: str | Mapping[str, Any],
        parameters: Mapping[str, Any] | None = None,
        /,
        *,
        tolerance: float = 1e-8,
        check: bool = True,
        **values: Any,
    ) -> Result | Study:
        """A study: of the file, by its name, or given as its table with ``kind`` and its keys.

        Raises:
            StudyError: the study cannot be done.
            ConvergenceError: it did not get where it was to go; ``.result`` is how far it came.
        """
        model, name = (self, study) if isinstance(study, str) else self._with_study(study)
        if name not in model.studies:
            known = ", ".join(model.studies) or "none"
            raise StudyError.at(f"study.{name}", f"there is no study `{name}`", hint=f"the model has {known}")
        native = model._mechanism.run(name, model._all(parameters, values), tolerance, _SHAPES)
        given = self.with_values(parameters, **values)
        result: Result | Study
        if native.solved is not None:
            result = Result(given, native.solved)
        else:
            result = _KINDS[native.kind](given, native)
        if check and native.status != "converged":
            raise ConvergenceError(f"{name}: {native.status}: {native.reason}", result)
        return result

    def _with_study(self, study: Mapping[str, Any]) -> tuple[Self, str]:
        keys = _values.table(study, "study")
        kind = str(keys.get("kind", "study"))
        other = self._copy()
        # Lines of a text that nobody has seen in this form are not told.
        studies = other._edited().setdefault("study", {})
        name = next(name for name in (kind, *(f"{kind}_{i}" for i in range(len(studies) + 1))) if name not in studies)
        studies[name] = keys
        return other, name

    def trace(
        self,
        parameter: Any,
        start: Any,
        end: Any,
        /,
        *,
        parameters: Mapping[str, Any] | None = None,
        tolerance: float = 1e-8,
        check: bool = True,
        **keys: Any,
    ) -> Path:
        """The path of equilibria as a parameter goes from ``start`` to ``end``, past folds and branch points.

        Further keywords are keys of a study of the kind ``trace``: ``branches=True``, ``event=[...]``, ``critical={...}``.
        ``parameters`` gives values of others.
        """
        study = {"kind": "trace", "parameter": str(parameter), "range": [start, end], **keys}
        found = self.run(study, parameters, tolerance=tolerance, check=check)
        assert isinstance(found, Path)
        return found

    def buckle(
        self,
        parameter: Any = None,
        /,
        *,
        parameters: Mapping[str, Any] | None = None,
        tolerance: float = 1e-8,
        check: bool = True,
        **keys: Any,
    ) -> Buckling:
        """Critical loads of the problem linearised about an equilibrium: of a parameter, or of all loads in proportion.

        Further keywords are keys of a study of the kind ``buckle``: ``at``, ``count``.
        """
        study = {"kind": "buckle", "parameter": None if parameter is None else str(parameter), **keys}
        found = self.run(study, parameters, tolerance=tolerance, check=check)
        assert isinstance(found, Buckling)
        return found

    def modes(
        self,
        count: int = 6,
        /,
        *,
        at_rest: bool = False,
        parameters: Mapping[str, Any] | None = None,
        tolerance: float = 1e-8,
        check: bool = True,
        **keys: Any,
    ) -> Modes:
        """Natural frequencies and shapes about the equilibrium, or about the state at rest without any load."""
        study = {"kind": "modes", "count": count, "at_rest": at_rest, **keys}
        found = self.run(study, parameters, tolerance=tolerance, check=check)
        assert isinstance(found, Modes)
        return found

    def state_space(
        self,
        count: int = 6,
        /,
        *,
        inputs: Sequence[str] = (),
        outputs: Sequence[str] = (),
        damping_ratio: float = 0.0,
        residual_vectors: int | None = None,
        at_rest: bool = False,
        parameters: Mapping[str, Any] | None = None,
        tolerance: float = 1e-8,
        **values: Any,
    ) -> StateSpace:
        """The linear model about the equilibrium with its ``count`` lowest modes, corrected for what the others yield statically.

        Args:
            inputs: ``load.NAME``, ``load.NAME.force.x``, ``load.NAME.moment.z``, ``ground.acceleration.y``; else all loads.
            outputs: ``NAME``, ``NAME.x``, ``NAME.velocity``, ``NAME.x.acceleration``; else all outputs.
            damping_ratio: damping of every mode beside the model's own, as a part of critical damping.
            residual_vectors: for each input; else as few as bring the response within 1e-6 of the whole one, up to three.

        Raises:
            ConvergenceError: there is no equilibrium.
        """
        text, mat, picture = self._mechanism.state_space(
            self._all(parameters, values),
            tolerance,
            (count, at_rest),
            [str(name) for name in inputs],
            [str(name) for name in outputs],
            damping_ratio,
            residual_vectors,
        )
        found = StateSpace(self.with_values(parameters, **values), text, mat, picture)
        if found.document["status"] != "converged":
            raise ConvergenceError(f"state space: {found.document['status']}: {found.document.get('reason')}", None)
        return found

    def frequencies(
        self,
        parameter: Any,
        start: Any,
        end: Any,
        /,
        *,
        count: int = 6,
        parameters: Mapping[str, Any] | None = None,
        tolerance: float = 1e-8,
        check: bool = True,
        **keys: Any,
    ) -> Frequencies:
        """Natural frequencies along the path of equilibria from one value of a parameter to another, followed by their shapes."""
        study = {"kind": "modes", "count": count, "parameter": str(parameter), "range": [start, end], **keys}
        found = self.run(study, parameters, tolerance=tolerance, check=check)
        assert isinstance(found, Frequencies)
        return found

    def inverse_dynamics(
        self,
        parameter: Any,
        /,
        *,
        parameters: Mapping[str, Any] | None = None,
        tolerance: float = 1e-8,
        check: bool = True,
        **keys: Any,
    ) -> Motion:
        """The forces of a motion in time that a parameter leads; keywords are keys of a study of that kind."""
        study = {"kind": "inverse_dynamics", "parameter": str(parameter), **keys}
        found = self.run(study, parameters, tolerance=tolerance, check=check)
        assert isinstance(found, Motion)
        return found

    def fit(
        self,
        data: Any,
        unknown: Any = (),
        /,
        *,
        parameters: Mapping[str, Any] | None = None,
        tolerance: float = 1e-8,
        check: bool = True,
        **keys: Any,
    ) -> Fit:
        """Unknown parameters from measurements: a CSV file, a DataFrame or lists by names of columns such as ``"pull [N]"``.

        Columns bear the names of parameters, which are set for the row, and of outputs, which were measured. Further keywords are
        keys of a study of the kind ``fit``: ``per_specimen=["young"]``, ``bounds={...}``, ``noise={...}``, ``loss="huber"``,
        ``intervals="profile"``, ``reject=True``.
        """
        from .fitting import measurements

        study = {"kind": "fit", "data": measurements(data), **keys}
        named = [str(name) for name in ([unknown] if isinstance(unknown, str) or not hasattr(unknown, "__iter__") else unknown)]
        if named:
            study["unknown"] = named
        found = self.run(study, parameters, tolerance=tolerance, check=check)
        assert isinstance(found, Fit)
        return found

    def formula(
        self,
        output: Any,
        of: Any,
        /,
        *,
        parameters: Mapping[str, Any] | None = None,
        tolerance: float = 1e-8,
        check: bool = True,
        **keys: Any,
    ) -> ResponseFormula:
        """A polynomial that repeats an output over a grid (``vary={"theta": ["-40 deg", "40 deg", 9]}``) or a trace of the model.

        Further keywords are keys of a study of the kind ``formula``: ``degree=3`` or ``terms=[...]``, ``pieces=[...]``, ``range={...}``.
        """
        names = [str(name) for name in ([of] if isinstance(of, str) or not hasattr(of, "__iter__") else of)]
        study = {"kind": "formula", "output": str(output), "of": names, **keys}
        found = self.run(study, parameters, tolerance=tolerance, check=check)
        assert isinstance(found, ResponseFormula)
        return found

    def optimise(
        self,
        vary: Mapping[Any, Any],
        /,
        *,
        parameters: Mapping[str, Any] | None = None,
        tolerance: float = 1e-8,
        check: bool = True,
        **keys: Any,
    ) -> Optimum:
        """Parameters that make an objective least or greatest under constraints.

        ``vary`` has a range, or a dict with ``range`` and ``guess``, for each parameter that may change; further keywords are keys
        of a study of the kind ``optimise``: ``minimise="model.mass"`` or ``maximise``, ``constraints=[{"output": ..., "most": ...}]``,
        ``starts=8``, ``pareto={...}``.
        """
        ranges = {str(name): own if isinstance(own, Mapping) else {"range": list(own)} for name, own in vary.items()}
        study = {"kind": "optimise", "vary": ranges, **keys}
        found = self.run(study, parameters, tolerance=tolerance, check=check)
        assert isinstance(found, Optimum)
        return found

    def stepper(self, inputs: Sequence[Any] = (), outputs: Sequence[Any] = (), *, tolerance: float = 1e-8) -> Stepper:
        """Solves one after another, each from where the last one ended; see :class:`flexura.Stepper`."""
        from .stepper import Stepper

        return Stepper(self, inputs, outputs, tolerance=tolerance)

    @overload
    def sweep(self, space: Any, outputs: Sequence[Any] | None = None, *, explain: Literal[True], **options: Any) -> Explanation: ...
    @overload
    def sweep(self, space: Any, outputs: Sequence[Any] | None = None, *, explain: Literal[False] = False, **options: Any) -> Sweep: ...
    def sweep(
        self, space: Any, outputs: Sequence[Any] | None = None, *, explain: bool = False, **options: Any
    ) -> Sweep | Explanation:
        """Many solves over a space of parameters; see :func:`flexura.sweep` for the options."""
        from .sweep import sweep

        found: Sweep | Explanation
        found = sweep(self, space, outputs, explain=True, **options) if explain else sweep(self, space, outputs, **options)
        return found


def load(path: str | os.PathLike[str]) -> Model:
    """Reads a model file.

    Raises:
        ModelError: it is wrong; with line, path and hint.
        OSError: it cannot be read.
    """
    model = Model()
    model._file = os.fspath(path)
    if not os.path.exists(model._file):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), model._file)
    model._cached = _native.Mechanism.read(model._file)
    model._text, model._tree = model._cached.text, None
    return model


def loads(text: str, folder: str | os.PathLike[str] = "") -> Model:
    """Understands a text as a model file; files that it names are looked for in ``folder``."""
    model = Model()
    model._text, model._tree = text, None
    model._file = os.path.join(folder, "model") if folder else ""
    _ = model._mechanism
    return model
