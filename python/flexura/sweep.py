"""Many solves over a space of parameters, on all cores or any executor, into a store that resumes.

A sample is solved from rest, so that its numbers depend neither on its neighbours nor on how the work is shared. Samples go
to workers in chunks; a worker writes its chunk to the store before it returns.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import os
import platform
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, overload

import numpy as np
import numpy.typing as npt

from . import _native
from ._references import Handle
from .errors import ModelError, StudyError
from .records import Array
from .store import Rows, Store, open_store

if TYPE_CHECKING:
    import pandas
    import xarray

    from .model import Model

#: Samples of a chunk at most; fewer where there are few samples for the workers.
_LARGEST_CHUNK = 256


class Explanation(NamedTuple):
    """What a sweep would do."""

    samples: int
    done: int
    failed: int
    missing: int
    chunks: int
    missing_chunks: int

    def __str__(self) -> str:
        return f"{self.samples} samples: {self.done} done ({self.failed} of them without an answer), {self.missing} to be solved"


@dataclass(frozen=True)
class Space:
    """Samples: a column for each parameter, SI units; of a grid also its axes."""

    names: tuple[str, ...]
    values: Array
    axes: tuple[Array, ...] | None = None


class Sweep:
    """The table of a sweep: a row for each sample, in the order of the space."""

    def __init__(self, model: Model, space: Space, columns: Mapping[str, int], rows: Rows, solved: int) -> None:
        self.model = model
        self.space = space
        self._columns = dict(columns)
        self._rows = rows
        #: How many samples were solved for it; the others were in the store.
        self.solved = solved

    @property
    def parameters(self) -> dict[str, Array]:
        """Values of the parameters (n,), SI."""
        return {name: self.space.values[:, i] for i, name in enumerate(self.space.names)}

    @property
    def outputs(self) -> dict[str, Array]:
        """Values of the outputs: (n,), or (n, 3) of vectors; NaN where a sample has none."""
        found, first = {}, 0
        for name, count in self._columns.items():
            block = self._rows.values[:, first : first + count]
            found[name] = block[:, 0] if count == 1 else block
            first += count
        return found

    @property
    def status(self) -> npt.NDArray[np.str_]:
        """How each sample ended: ``converged``, ``stalled``, ``input_error`` ..."""
        return np.array(self._rows.words)[self._rows.codes]

    @property
    def converged(self) -> npt.NDArray[np.bool_]:
        """Which samples have an answer."""
        found: npt.NDArray[np.bool_] = self.status == "converged"
        return found

    @property
    def reasons(self) -> dict[int, str]:
        """Why a sample has no answer, or an output of it no value, by the number of the sample."""
        return dict(self._rows.reasons)

    def __len__(self) -> int:
        return len(self.space.values)

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each sample; units stand in ``attrs``."""
        import pandas

        data: dict[str, Any] = dict(self.parameters)
        for name, values in self.outputs.items():
            data |= {name: values} if values.ndim == 1 else {f"{name}.{c}": values[:, i] for i, c in enumerate("xyz")}
        data["status"] = pandas.Categorical(self.status, categories=self._rows.words)
        reasons = np.full(len(self), None, dtype=object)
        for number, reason in self._rows.reasons.items():
            reasons[number] = reason
        table = pandas.DataFrame({**data, "reason": reasons})
        units = {name: unit for name, (_, unit) in self.model.parameters.items() if name in self.space.names}
        table.attrs["units"] = {**units, **self.model.outputs}
        return table

    def to_xarray(self) -> xarray.Dataset:
        """A grid as an array of as many dimensions, other samples along one; units stand in ``attrs``."""
        import xarray

        space = self.space
        units = {name: {"units": unit} for name, (_, unit) in self.model.parameters.items()}
        if space.axes is not None:
            dims, shape = space.names, tuple(len(axis) for axis in space.axes)
            coordinates: dict[str, Any] = {n: ((n,), a, units[n]) for n, a in zip(space.names, space.axes, strict=True)}
        else:
            dims, shape = ("sample",), (len(self),)
            coordinates = {n: (("sample",), v, units[n]) for n, v in self.parameters.items()}
        data: dict[str, Any] = {}
        for name, values in self.outputs.items():
            inner = ("component",) if values.ndim == 2 else ()
            data[name] = (dims + inner, values.reshape(shape + values.shape[1:]), {"units": self.model.outputs[name]})
        data["status"] = (dims, self.status.reshape(shape))
        if any(values.ndim == 2 for values in self.outputs.values()):
            coordinates["component"] = ["x", "y", "z"]
        return xarray.Dataset(data, coordinates, {"model": self.model.name, "key": self.model.key})

    def __repr__(self) -> str:
        without = len(self) - int(self.converged.sum())
        return f"<flexura.Sweep {self.model.name!r}: {len(self)} samples over {', '.join(self.space.names)}, {without} without an answer>"


def _column(model: Model, name: str, values: Iterable[Any]) -> list[float]:
    """Values of a parameter as numbers, texts and quantities in its SI unit."""
    from . import _values

    known: dict[str, float] = {}
    numbers = []
    for value in values:
        found = _values.parameter(value, f"parameter.{name}")
        if isinstance(found, str):
            if found not in known:
                known[found] = model._mechanism.value(name, found)
            found = known[found]
        numbers.append(found)
    return numbers


def _space(model: Model, space: Any) -> Space:
    """A grid, a DataFrame, a list of dicts, or names with a table of numbers."""
    if isinstance(space, Space):
        return space
    if hasattr(space, "columns") and hasattr(space, "to_numpy"):
        names = [str(name) for name in space.columns]
        columns = [_column(model, name, space[column].tolist()) for name, column in zip(names, space.columns, strict=True)]
        return _checked(model, Space(tuple(names), np.array(columns, dtype=float).reshape(len(names), -1).T))
    if isinstance(space, Mapping):
        names = [name.name if isinstance(name, Handle) else str(name) for name in space]
        for name in names:
            _known(model, name)
        axes = tuple(np.array(_column(model, name, _list(values)), dtype=float) for name, values in zip(names, space.values(), strict=True))
        count = int(np.prod([len(axis) for axis in axes], dtype=float)) if axes else 0
        table = np.empty((count, len(axes)))
        for i, mesh in enumerate(np.meshgrid(*axes, indexing="ij") if axes else ()):
            table[:, i] = mesh.reshape(-1)
        return _checked(model, Space(tuple(names), table, axes))
    if isinstance(space, tuple) and len(space) == 2:
        names, table = [str(name) for name in space[0]], np.atleast_2d(np.asarray(space[1], dtype=float))
        if table.shape[1] != len(names):
            raise StudyError(f"the sample has {table.shape[1]} columns for {len(names)} parameters")
        return _checked(model, Space(tuple(names), table))
    if isinstance(space, Sequence) and all(isinstance(row, Mapping) for row in space):
        names = list(dict.fromkeys(str(name) for row in space for name in row))
        defaults = {name: quantity.value for name, quantity in model.parameters.items()}
        rows = [{str(name): value for name, value in row.items()} for row in space]
        for name in names:
            _known(model, name)
        columns = [_column(model, name, [row.get(name, defaults[name]) for row in rows]) for name in names]
        return _checked(model, Space(tuple(names), np.array(columns, dtype=float).reshape(len(names), -1).T))
    raise StudyError(
        "the space is a dict of lists (a grid), a DataFrame, a list of dicts, or a pair of names and an array (n, parameters)"
    )


def _list(values: Any) -> list[Any]:
    """Values of one parameter; one alone is a list of one."""
    if isinstance(values, np.ndarray):
        return list(values.reshape(-1))
    return list(values) if isinstance(values, Iterable) and not isinstance(values, str) else [values]


def _known(model: Model, name: str) -> None:
    if name not in model.parameters:
        raise ModelError.at(f"parameter.{name}", f"there is no parameter `{name}` to vary", hint=f"there are {', '.join(model.parameters)}")
    if name in model.unknowns:
        raise ModelError.at(f"parameter.{name}", "is an unknown, which every solve finds; vary another parameter")


def _checked(model: Model, space: Space) -> Space:
    for name in space.names:
        _known(model, name)
    if not space.values.size:
        raise StudyError("the space has no samples")
    if not np.isfinite(space.values).all():
        row, column = np.argwhere(~np.isfinite(space.values))[0]
        raise ModelError.at(f"parameter.{space.names[column]}", f"sample {row} has no finite number", space.values[row, column])
    return space


@dataclass(frozen=True)
class _Job:
    """What a worker must know; it travels with every chunk."""

    model: Model
    names: tuple[str, ...]
    outputs: tuple[int, ...]
    columns: int
    tolerance: float
    continuation: bool
    store: Store | None
    key: str


class _Stop:
    """Set where nobody waits for the rest any more; it does not travel."""

    def __init__(self) -> None:
        self.event = threading.Event()

    def __reduce__(self) -> tuple[Any, ...]:
        return _Stop, ()


#: Models that a process has read, by the keys of their sweeps.
_READ: dict[str, _native.Mechanism] = {}


def _mechanism(job: _Job) -> _native.Mechanism:
    if job.key not in _READ:
        if len(_READ) > 8:
            _READ.clear()
        _READ[job.key] = job.model._mechanism
    return _READ[job.key]


def _work(job: _Job, number: int, first: int, samples: Array, again: npt.NDArray[np.bool_] | None, stop: _Stop) -> tuple[int, Rows, int] | None:
    """Solves a chunk and writes it; None where the end was asked for. ``again`` tells which samples to solve anew."""
    kept = None
    if job.store is not None and job.store.is_done(number):
        kept = job.store.read(number)
        if again is None:
            return first, kept, 0
    mechanism, fixed = _mechanism(job), list(job.model.values.items())
    rows = Rows.empty(len(samples), job.columns)
    previous: Any = None
    solved = 0
    for i, sample in enumerate(samples):
        if stop.event.is_set():
            return None
        if kept is not None and again is not None and not again[i]:
            rows.take(i, kept)
            continue
        values = [*fixed, *zip(job.names, sample.tolist(), strict=True)]
        if job.continuation:
            status, reason, numbers, previous = _continued(job, mechanism, values, previous)
        else:
            status, reason, numbers = mechanism.sample(values, job.tolerance, list(job.outputs))
        rows.put(i, status, reason, numbers)
        solved += 1
    if job.store is not None:
        job.store.write(number, first, job.names, samples, rows)
    return first, rows, solved


def _continued(job: _Job, mechanism: _native.Mechanism, values: Any, previous: Any) -> tuple[str, str | None, list[float] | None, Any]:
    """A sample from the equilibrium of the one before it, from rest where that is not near."""
    try:
        solved = mechanism.solve(values, job.tolerance, 2, False, [], previous)
    except ModelError as error:
        return "input_error", str(error).split("\n", 1)[0], None, previous
    if solved.status != "converged":
        return solved.status, solved.reason, None, previous
    found, numbers = solved.outputs(), list[float]()
    described = mechanism.describe()["outputs"]
    for position in job.outputs:
        name, _, count = described[position]
        numbers += np.atleast_1d(found[name]).tolist() if name in found else [float("nan")] * count
    reasons = solved.output_reasons()
    return solved.status, reasons[0][1] if reasons else None, numbers, solved


@overload
def sweep(
    model: Model,
    space: Any,
    outputs: Sequence[Any] | None = None,
    *,
    explain: Literal[True],
    store: str | os.PathLike[str] | None = None,
    executor: Executor | None = None,
    chunk: int | None = None,
    tolerance: float = 1e-8,
    continuation: bool = False,
    retry: Literal["failed"] | None = None,
    progress: bool | None = None,
) -> Explanation: ...
@overload
def sweep(
    model: Model,
    space: Any,
    outputs: Sequence[Any] | None = None,
    *,
    store: str | os.PathLike[str] | None = None,
    executor: Executor | None = None,
    chunk: int | None = None,
    tolerance: float = 1e-8,
    continuation: bool = False,
    retry: Literal["failed"] | None = None,
    progress: bool | None = None,
    explain: Literal[False] = False,
) -> Sweep: ...
def sweep(
    model: Model,
    space: Any,
    outputs: Sequence[Any] | None = None,
    *,
    store: str | os.PathLike[str] | None = None,
    executor: Executor | None = None,
    chunk: int | None = None,
    tolerance: float = 1e-8,
    continuation: bool = False,
    retry: Literal["failed"] | None = None,
    progress: bool | None = None,
    explain: bool = False,
) -> Sweep | Explanation:
    """Solves a model at every sample of a space.

    Args:
        space: a dict of lists (their grid, the last one fastest), a DataFrame, a list of dicts, or names with an array (n, p) such
            as a sample of scipy.stats or SALib. Numbers are SI; texts and quantities have units.
        outputs: which outputs; all of them unless given.
        store: where the samples go: ``NAME.zarr``, ``NAME.parquet`` or ``NAME.csv``. What is there is not solved again.
        executor: any ``concurrent.futures.Executor``, such as ``client.get_executor()`` of Dask; threads on all cores unless
            given.
        chunk: samples that a worker solves before it writes.
        tolerance: as of :meth:`Model.solve`.
        continuation: begin each sample of a chunk at the answer before it; faster, but near a fold the answer may depend on the
            neighbours.
        retry: "failed" solves again those samples of the store that have no answer.
        progress: a bar on standard error; on a terminal unless given.
        explain: say what would be solved, and solve nothing.

    Raises:
        StudyError: the store belongs to another sweep.
        ModelError: the model or the space is wrong. A single sample that is wrong is a row that says so.
    """
    if retry not in (None, "failed"):
        raise StudyError(f"retry is None or 'failed', not {retry!r}")
    table = _space(model, space)
    described = model._described["outputs"]
    known = [name for name, _, _ in described]
    wanted = known if outputs is None else [output.name if isinstance(output, Handle) else str(output) for output in outputs]
    for name in wanted:
        if name not in known:
            raise StudyError.at(f"output.{name}", f"there is no output `{name}`", hint=f"there are {', '.join(known) or 'none'}")
    positions = tuple(known.index(name) for name in wanted)
    columns = {name: described[position][2] for name, position in zip(wanted, positions, strict=True)}
    names = [label for name, count in columns.items() for label in ([name] if count == 1 else [f"{name}.{c}" for c in "xyz"])]
    workers = getattr(executor, "_max_workers", None) or os.cpu_count() or 1
    size = chunk or max(1, min(_LARGEST_CHUNK, -(-len(table.values) // (4 * workers))))
    about = {
        "key": _key(model, table, names, tolerance, continuation),
        "flexura": _native.__version__,
        "model": model.to_toml(),
        "values": model.values,
        "parameters": list(table.names),
        "columns": names,
        "units": {**{n: q.unit for n, q in model.parameters.items() if n in table.names}, **model.outputs},
        "tolerance": tolerance,
        "continuation": continuation,
        "samples": len(table.values),
        "chunk": size,
        "python": platform.python_version(),
        "platform": platform.platform(),
    }
    place = None if store is None else open_store(store, about, create=not explain)
    if place is not None:
        size = place.chunk
    rows = Rows.empty(len(table.values), len(names))
    todo = list(_chunks(table, size, place, rows, retry == "failed"))
    if explain:
        done = rows.codes != 0
        failed = int((done & (rows.codes != rows.code("converged"))).sum())
        missing = sum(len(job[2]) if job[3] is None else int(job[3].sum()) for job in todo)
        return Explanation(len(done), int(done.sum()), failed, missing, -(-len(done) // size), len(todo))
    job = _Job(model, table.names, positions, len(names), tolerance, continuation, place, str(about["key"]))
    solved = 0
    for first, found, count in _run(job, todo, executor, workers, _bar(progress, len(table.values), todo)):
        rows.merge(first, found)
        solved += count
    return Sweep(model, table, columns, rows, solved)


_Todo = tuple[int, int, Array, "npt.NDArray[np.bool_] | None"]


def _chunks(table: Space, size: int, store: Store | None, rows: Rows, retry: bool) -> Iterator[_Todo]:
    """The chunks that are to be solved; those that are done go into the rows."""
    for number, first in enumerate(range(0, len(table.values), size)):
        samples = table.values[first : first + size]
        if store is None or not store.is_done(number):
            yield number, first, samples, None
            continue
        kept = store.read(number)
        rows.merge(first, kept)
        failed = kept.codes != kept.code("converged")
        if retry and failed.any():
            yield number, first, samples, failed


def _run(
    job: _Job, todo: list[_Todo], executor: Executor | None, workers: int, bar: Callable[[int], None]
) -> Iterator[tuple[int, Rows, int]]:
    stop = _Stop()
    pool = executor or ThreadPoolExecutor(workers)
    waiting: set[Future[Any]] = set()
    left = iter(todo)
    try:
        while True:
            # So many ahead that no worker waits, but not all of a million.
            for item in itertools.islice(left, max(0, 4 * workers + 64 - len(waiting))):
                waiting.add(pool.submit(_work, job, *item, stop))
            if not waiting:
                return
            done, waiting = wait(waiting, return_when=FIRST_COMPLETED)
            for future in done:
                found = future.result()
                if found is not None:
                    bar(found[2])
                    yield found
    finally:
        stop.event.set()
        for future in waiting:
            future.cancel()
        if executor is None:
            pool.shutdown(cancel_futures=True)
        bar(-1)


def _bar(progress: bool | None, samples: int, todo: list[_Todo]) -> Callable[[int], None]:
    if progress is False or (progress is None and not sys.stderr.isatty()) or not todo:
        return lambda _: None
    try:
        from tqdm import tqdm
    except ImportError:
        if progress:
            raise
        return lambda _: None
    missing = sum(len(item[2]) if item[3] is None else int(item[3].sum()) for item in todo)
    bar = tqdm(total=samples, initial=samples - missing, unit="sample")

    def update(count: int) -> None:
        bar.close() if count < 0 else bar.update(count)

    return update


def _key(model: Model, table: Space, columns: list[str], tolerance: float, continuation: bool) -> str:
    """What makes the numbers of a sweep: model, values, samples, tolerance, version."""
    about = [model.key, table.names, columns, tolerance, continuation, _native.__version__]
    digest = hashlib.sha256(json.dumps(about).encode())
    digest.update(np.ascontiguousarray(table.values).tobytes())
    return digest.hexdigest()


__all__ = ["Explanation", "Space", "Sweep", "sweep"]
