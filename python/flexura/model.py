"""Models: read from a file or built by keywords, checked and solved."""

from __future__ import annotations

import errno
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, Self, overload

from . import _native, _values
from ._built import Built, Check, Quantity
from ._references import Handle
from .control import StateSpace
from .errors import ConvergenceError, StudyError
from .result import Result
from .fitting import Fit, ResponseFormula
from .studies import Buckling, Frequencies, Modes, Motion, Optimum, Path, Study

if TYPE_CHECKING:
    from .stepper import Stepper
    from .sweep import Explanation, Sweep

__all__ = ["Check", "Model", "Quantity", "load", "loads"]

#: Shapes between those states of a path that are kept whole: sections along each beam.
_SHAPES = 17

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


class Model(Built):
    """A compliant mechanism.

    ``Model("name")`` begins an empty one. Every table of the model file is a method: ``m.beam("a", length="100 mm", ...)`` is the
    table ``[beam.a]``, ``m.parameter("travel", "20 mm")`` a line of ``[parameter]``; what is not a named table is a keyword here,
    as in ``Model("name", gravity=[0, 0, "-9.81 m/s^2"])``. Values are numbers in SI units, texts with a unit, quantities of
    pint, formulas, lists and dicts.

    A model is checked when it is first used; what is wrong then raises :class:`ModelError` with the path of the key.
    """

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
