"""Where the samples of a sweep are kept: each chunk whole, or not at all.

A chunk is written beside its place and renamed, or marked as done only when all of it is written, so that whatever is killed
leaves nothing half.
"""

from __future__ import annotations

import csv
import io
import json
import math
import os
import shutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from .errors import StudyError
from .records import Array

#: The words for how a sample ends; code 0 is one that is not solved.
WORDS = [
    "missing",
    "converged",
    "stalled",
    "iteration_limit",
    "singular",
    "inconsistent",
    "accuracy_limit",
    "interrupted",
    "input_error",
]


@dataclass
class Rows:
    """Samples: the codes of how they ended, the numbers of their outputs, the reasons of some."""

    codes: npt.NDArray[np.uint8]
    values: Array
    reasons: dict[int, str]

    @property
    def words(self) -> list[str]:
        """What the codes mean."""
        return WORDS

    @classmethod
    def empty(cls, count: int, columns: int) -> Rows:
        """So many samples that are not solved."""
        return cls(np.zeros(count, dtype=np.uint8), np.full((count, columns), np.nan), {})

    def code(self, word: str) -> int:
        """The code of a word."""
        return WORDS.index(word)

    def put(self, i: int, word: str, reason: str | None, numbers: Sequence[float] | None) -> None:
        """What a sample came to."""
        self.codes[i] = self.code(word)
        if numbers is not None:
            self.values[i] = numbers
        if reason is not None:
            self.reasons[i] = reason

    def take(self, i: int, other: Rows) -> None:
        """A sample of other rows, at the same place."""
        self.codes[i], self.values[i] = other.codes[i], other.values[i]
        if i in other.reasons:
            self.reasons[i] = other.reasons[i]

    def merge(self, first: int, chunk: Rows) -> None:
        """A chunk, from sample ``first`` on."""
        last = first + len(chunk.codes)
        self.codes[first:last], self.values[first:last] = chunk.codes, chunk.values
        for i in range(first, last) if self.reasons else ():
            self.reasons.pop(i, None)
        self.reasons.update({first + i: reason for i, reason in chunk.reasons.items()})


class Store(Protocol):
    """A place for chunks, which travels to workers."""

    @property
    def chunk(self) -> int:
        """Samples in a chunk."""

    def is_done(self, number: int) -> bool:
        """Is the chunk there, whole?"""

    def read(self, number: int) -> Rows:
        """A chunk that is there."""

    def write(self, number: int, first: int, names: Sequence[str], samples: Array, rows: Rows) -> None:
        """Puts a chunk in its place."""


def open_store(path: str | os.PathLike[str], about: Mapping[str, Any], create: bool) -> Store | None:
    """The store at a path, its kind told by the name; None where there is none and none is to be made.

    Raises:
        StudyError: it belongs to another sweep, or is of an unknown kind.
    """
    kinds: dict[str, type[ZarrStore | ParquetStore | CsvStore]] = {".zarr": ZarrStore, ".parquet": ParquetStore, ".csv": CsvStore}
    place = Path(path)
    if place.suffix not in kinds:
        raise StudyError(f"the store {place} is of an unknown kind: its name ends in .zarr, .parquet or .csv")
    kind = kinds[place.suffix]
    known: Mapping[str, Any] | None = kind.about(place)
    if known is None:
        if place.exists() and (place.is_file() or any(place.iterdir())):
            raise StudyError(f"{place} is there already and is no store of a sweep; name another place")
        if not create:
            return None
        kind.create(place, about)
        # Another process may have begun it meanwhile.
        known = kind.about(place) or about
    if known.get("key") != about["key"]:
        what = ("model", "values", "parameters", "columns", "tolerance", "continuation", "samples", "flexura")
        differing = [word for word in what if known.get(word) != about.get(word)] or ["the samples themselves"]
        raise StudyError(f"the store {place} belongs to another sweep (other: {', '.join(differing)}); name another place, or remove it")
    return kind(place, known)


def _begin(place: Path, fill: Callable[[Path], None]) -> None:
    """A folder, filled beside its place, so that it is there whole or not at all."""
    place.parent.mkdir(parents=True, exist_ok=True)
    beside = place.with_name(f".{place.name}.{os.getpid()}.tmp")
    shutil.rmtree(beside, ignore_errors=True)
    beside.mkdir()
    fill(beside)
    try:
        os.replace(beside, place)
    except OSError:
        # Another process was faster.
        shutil.rmtree(beside, ignore_errors=True)


def _replace(path: Path, content: bytes) -> None:
    beside = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    with open(beside, "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    os.replace(beside, path)


class _Kept:
    """What all kinds share."""

    def __init__(self, place: Path, about: Mapping[str, Any]) -> None:
        self._place = place
        self._columns = list(about["columns"])
        self._samples = int(about["samples"])
        self._chunk = int(about["chunk"])

    @property
    def chunk(self) -> int:
        """Samples in a chunk."""
        return self._chunk

    def _range(self, number: int) -> tuple[int, int]:
        return number * self._chunk, min((number + 1) * self._chunk, self._samples)


class ParquetStore(_Kept):
    """A folder with a file for each chunk, which any reader of Parquet takes as one table."""

    @staticmethod
    def _notes(place: Path) -> Path:
        return place / "_sweep.json"

    @classmethod
    def about(cls, place: Path) -> dict[str, Any] | None:
        """What it is of."""
        notes = cls._notes(place)
        found: dict[str, Any] | None = json.loads(notes.read_text(encoding="utf-8")) if notes.is_file() else None
        return found

    @classmethod
    def create(cls, place: Path, about: Mapping[str, Any]) -> None:
        """Begins it."""
        _begin(place, lambda beside: _replace(cls._notes(beside), json.dumps(about, indent=2).encode()))

    def _part(self, number: int) -> Path:
        return self._place / f"part-{number:07d}.parquet"

    def is_done(self, number: int) -> bool:
        """Is the chunk there?"""
        return self._part(number).is_file()

    def read(self, number: int) -> Rows:
        """A chunk that is there."""
        import pyarrow.parquet

        table = pyarrow.parquet.read_table(self._part(number))
        codes = np.array([WORDS.index(word) for word in table["status"].to_pylist()], dtype=np.uint8)
        values = np.stack([table[name].to_numpy() for name in self._columns], axis=1) if self._columns else np.empty((len(codes), 0))
        reasons = {i: reason for i, reason in enumerate(table["reason"].to_pylist()) if reason is not None}
        return Rows(codes, values, reasons)

    def write(self, number: int, first: int, names: Sequence[str], samples: Array, rows: Rows) -> None:
        """Puts a chunk in its place."""
        import pyarrow
        import pyarrow.parquet

        data: dict[str, Any] = {"sample": np.arange(first, first + len(samples))}
        data |= {name: samples[:, i] for i, name in enumerate(names)}
        data |= {name: rows.values[:, i] for i, name in enumerate(self._columns)}
        data["status"] = [WORDS[code] for code in rows.codes]
        data["reason"] = pyarrow.array([rows.reasons.get(i) for i in range(len(samples))], pyarrow.string())
        buffer = io.BytesIO()
        pyarrow.parquet.write_table(pyarrow.table(data), buffer)
        _replace(self._part(number), buffer.getvalue())


class ZarrStore(_Kept):
    """A group of arrays, one for each column, in chunks that are files of their own."""

    @classmethod
    def about(cls, place: Path) -> dict[str, Any] | None:
        """What it is of."""
        import zarr

        if not (place / "done").is_dir():
            return None
        attributes = dict(zarr.open_group(place, mode="r").attrs)
        return attributes if "key" in attributes else None

    @classmethod
    def create(cls, place: Path, about: Mapping[str, Any]) -> None:
        """Begins it."""
        _begin(place, lambda beside: cls._fill(beside, about))

    @staticmethod
    def _fill(place: Path, about: Mapping[str, Any]) -> None:
        import zarr

        group = zarr.open_group(place, mode="w")
        count, chunk = int(about["samples"]), int(about["chunk"])
        for name in [*about["parameters"], *about["columns"]]:
            array = group.create_array(name, shape=(count,), chunks=(chunk,), dtype="float64", fill_value=math.nan)
            array.attrs["units"] = about["units"].get(name.removesuffix(name[-2:]) if name[-2:] in {".x", ".y", ".z"} else name, "")
        group.create_array("status", shape=(count,), chunks=(chunk,), dtype="uint8", fill_value=0).attrs["words"] = WORDS
        # JSON in bytes, so that any reader of Zarr gets it.
        chunks = -(-count // chunk)
        group.create_array("reasons", shape=(chunks,), chunks=(1,), dtype=str, fill_value="")
        group.attrs.update(dict(about))
        group.create_array("done", shape=(chunks,), chunks=(1,), dtype="uint8", fill_value=0)

    def __init__(self, place: Path, about: Mapping[str, Any]) -> None:
        super().__init__(place, about)
        self._group: Any = None
        self._done: Any = None

    def _open(self) -> Any:
        if self._group is None:
            import zarr

            self._group = zarr.open_group(self._place, mode="r+")
        return self._group

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_group": None, "_done": None}

    def is_done(self, number: int) -> bool:
        """Is the chunk there? One that another process has written since is looked for in a copy of this."""
        if self._done is None:
            self._done = self._open()["done"][:]
        return bool(self._done[number] == 1)

    def read(self, number: int) -> Rows:
        """A chunk that is there."""
        group, (first, last) = self._open(), self._range(number)
        values = np.full((last - first, len(self._columns)), np.nan)
        for i, name in enumerate(self._columns):
            values[:, i] = group[name][first:last]
        text = str(group["reasons"][number])
        reasons = {int(i): reason for i, reason in json.loads(text).items()} if text else {}
        return Rows(np.asarray(group["status"][first:last], dtype=np.uint8), values, reasons)

    def write(self, number: int, first: int, names: Sequence[str], samples: Array, rows: Rows) -> None:
        """Puts a chunk in its place, and says last that it is there."""
        group, last = self._open(), first + len(samples)
        for i, name in enumerate(names):
            group[name][first:last] = samples[:, i]
        for i, name in enumerate(self._columns):
            group[name][first:last] = rows.values[:, i]
        group["status"][first:last] = rows.codes
        group["reasons"][number] = json.dumps(rows.reasons) if rows.reasons else ""
        group["done"][number] = 1


class CsvStore(_Kept):
    """A single table to which chunks are added, each by one write; for small sweeps."""

    @staticmethod
    def _notes(place: Path) -> Path:
        return place.with_name(place.name + ".json")

    @classmethod
    def about(cls, place: Path) -> dict[str, Any] | None:
        """What it is of."""
        notes = cls._notes(place)
        found: dict[str, Any] | None = json.loads(notes.read_text(encoding="utf-8")) if notes.is_file() else None
        return found

    @classmethod
    def create(cls, place: Path, about: Mapping[str, Any]) -> None:
        """Begins it."""
        place.parent.mkdir(parents=True, exist_ok=True)
        _replace(cls._notes(place), json.dumps(about, indent=2).encode())

    def __init__(self, place: Path, about: Mapping[str, Any]) -> None:
        super().__init__(place, about)
        self._parameters = len(about["parameters"])
        self._known: dict[int, list[str]] | None = None
        if not place.exists():
            _replace(place, _line(["sample", *about["parameters"], *about["columns"], "status", "reason"]).encode())
        content = place.read_bytes() if place.is_file() else b""
        whole = content.rfind(b"\n") + 1
        if whole < len(content):
            # The end of a write that was killed.
            os.truncate(place, whole)

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_known": None}

    def _rows(self) -> dict[int, list[str]]:
        if self._known is None:
            self._known = {}
            if self._place.is_file():
                with open(self._place, newline="", encoding="utf-8") as file:
                    for row in list(csv.reader(file))[1:]:
                        # A later row stands in place of an earlier one.
                        if len(row) == 3 + self._parameters + len(self._columns):
                            self._known[int(row[0])] = row
        return self._known

    def is_done(self, number: int) -> bool:
        """Are all its samples there?"""
        first, last = self._range(number)
        return all(i in self._rows() for i in range(first, last))

    def read(self, number: int) -> Rows:
        """A chunk that is there."""
        first, last = self._range(number)
        rows = Rows.empty(last - first, len(self._columns))
        for i in range(first, last):
            row = self._rows()[i]
            numbers = [float(text) if text else math.nan for text in row[1 + self._parameters : -2]]
            rows.put(i - first, row[-2], row[-1] or None, numbers)
        return rows

    def write(self, number: int, first: int, names: Sequence[str], samples: Array, rows: Rows) -> None:
        """Adds a chunk."""
        lines = []
        for i, sample in enumerate(samples):
            numbers = [repr(value) for value in sample.tolist()]
            numbers += ["" if math.isnan(value) else repr(value) for value in rows.values[i].tolist()]
            reason = rows.reasons.get(i, "").replace("\n", " ")
            lines.append(_line([str(first + i), *numbers, WORDS[rows.codes[i]], reason]))
        file = os.open(self._place, os.O_WRONLY | os.O_APPEND)
        try:
            os.write(file, "".join(lines).encode())
            os.fsync(file)
        finally:
            os.close(file)


def _line(fields: Sequence[str]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerow(fields)
    return buffer.getvalue()
