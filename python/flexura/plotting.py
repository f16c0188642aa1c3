"""Pictures by matplotlib."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from .records import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .result import Result
    from .studies import Path

#: Part of the size below which a mechanism counts as lying in a plane.
_FLAT = 1e-9


def _courses(result: Result) -> list[tuple[str, Array]]:
    """Everything that is drawn as a line, with its kind."""
    lines = [("beam", beam.position) for beam in result.beams.values()]
    for kind in ("cables", "springs", "tubes"):
        for thing in getattr(result, kind).values():
            course = thing.get("course" if kind != "tubes" else "position")
            if course is not None and len(course) > 1:
                lines.append((kind, np.asarray(course, dtype=float)))
    return lines


def plot_shape(result: Result, axes: Axes | None = None, **style: Any) -> Axes:
    """The deformed shape; ``style`` goes to the lines of the beams."""
    import matplotlib.pyplot as plt

    lines = _courses(result)
    bodies = np.array([body.position for body in result.bodies.values()]).reshape(-1, 3)
    points = np.concatenate([*(line for _, line in lines), bodies]) if lines or len(bodies) else np.zeros((1, 3))
    spans = np.ptp(points, axis=0)
    size = float(spans.max()) or 1.0
    flat = [axis for axis in (2, 1, 0) if spans[axis] <= _FLAT * size]
    in_space = axes.name == "3d" if axes is not None else not flat
    shown = [0, 1, 2] if in_space else [axis for axis in range(3) if axis != (flat or [2])[0]]
    if axes is None:
        _, axes = plt.subplots(subplot_kw={"projection": "3d"} if in_space else {})
    colours = {"beam": "C0", "cables": "C1", "springs": "C2", "tubes": "C0"}
    for kind, line in lines:
        given = style if kind == "beam" else {}
        axes.plot(*line[:, shown].T, **{"color": colours[kind], **given})
    if len(bodies):
        axes.plot(*bodies[:, shown].T, linestyle="none", marker="s", color="0.3", markersize=4)
    labels = [f"{'xyz'[axis]} / m" for axis in shown]
    axes.set_xlabel(labels[0])
    axes.set_ylabel(labels[1])
    if in_space:
        axes.set_zlabel(labels[2])  # type: ignore[attr-defined]
    axes.set_aspect("equal")
    axes.set_title(result.model.name)
    return axes


def _runs(states: list[bool | None]) -> list[tuple[int, int, bool | None]]:
    """Stretches between points that are stable alike; a stretch takes the state of what lies between its ends."""
    pieces: list[tuple[int, int, bool | None]] = []
    for (i, a), (j, b) in pairwise(enumerate(states)):
        state = a if a == b or b is None else b if a is None else None
        if pieces and pieces[-1][2] == state:
            pieces[-1] = (pieces[-1][0], j, state)
        else:
            pieces.append((i, j, state))
    return pieces


def plot_path(path: Path, output: Any = None, axes: Axes | None = None, **style: Any) -> Axes:
    """An output (``"tip"``, or ``"tip.x"`` of a vector) over the parameter."""
    import matplotlib.pyplot as plt

    name = str(output) if output is not None else next(iter(path.model.outputs))
    base, _, letter = name.rpartition(".") if name not in path.model.outputs else (name, "", "")
    if axes is None:
        _, axes = plt.subplots()
    lines = {True: "-", False: "--", None: ":"}
    for number, branch in enumerate(path.branches):
        values = branch.output(base)
        if values.ndim == 2:
            values = values[:, "xyz".index(letter or "x")]
        for first, last, state in _runs(branch.stable):
            piece = slice(first, last + 1)
            look = {"color": f"C{number % 10}", "linestyle": lines[state], **style}
            axes.plot(branch.parameter[piece], values[piece], **look)
        for kind, marker in (("fold", "o"), ("branch", "D")):
            found = [i for i, other in enumerate(branch.kinds) if other == kind]
            axes.plot(branch.parameter[found], values[found], linestyle="none", marker=marker, color="k", markersize=4)
    unit = path.model.parameters[path.parameter].unit
    axes.set_xlabel(f"{path.parameter} / {unit}" if unit else path.parameter)
    unit = path.model.outputs.get(base, "")
    axes.set_ylabel(f"{name} / {unit}" if unit else name)
    axes.set_title(path.model.name)
    return axes
