"""Parts of result documents: numbers as arrays, tables by name."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, Generic, TypeVar

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

T = TypeVar("T")


def _is_numeric(value: Any) -> bool:
    if isinstance(value, list):
        return all(_is_numeric(item) for item in value)
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def shown(value: Any) -> Any:
    """A part of a document: lists of numbers become arrays, tables become records."""
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list):
        if value and _is_numeric(value):
            try:
                return np.array(value, dtype=float)
            except ValueError:
                # Rows of different lengths.
                return [shown(item) for item in value]
        return [shown(item) for item in value]
    return value


class Record(Mapping[str, Any]):
    """A part of a result: its entries by attribute or key."""

    def __init__(self, entries: Mapping[str, Any]) -> None:
        self._entries = entries
        self._made: dict[str, Any] = {}

    def __getitem__(self, key: str) -> Any:
        if key not in self._made:
            self._made[key] = shown(self._entries[key])
        return self._made[key]

    def __getattr__(self, key: str) -> Any:
        if key.startswith("_") or key not in self._entries:
            raise AttributeError(f"there is no {key!r} here, but {', '.join(self._entries) or 'nothing'}")
        return self[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._entries]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{key}={_short(self[key])}' for key in self)})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Record) and equal(dict(self), dict(other))

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self._entries),)


class Named(Mapping[str, T], Generic[T]):
    """Things by name, each made when it is asked for."""

    def __init__(self, kind: str, names: list[str], make: Callable[[str], T]) -> None:
        self._kind = kind
        self._names = names
        self._make = make
        self._made: dict[str, T] = {}

    def __getitem__(self, key: Any) -> T:
        name = str(key)
        if name not in self._made:
            if name not in self._names:
                raise KeyError(f"there is no {self._kind} {name!r}, but {', '.join(self._names) or 'none'}")
            self._made[name] = self._make(name)
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"<{self._kind}: {', '.join(self._names) or 'none'}>"


def _short(value: Any) -> str:
    if isinstance(value, np.ndarray) and value.size > 6:
        return f"array{value.shape}"
    if isinstance(value, list) and len(value) > 4:
        return f"[{len(value)} entries]"
    return repr(value)


def equal(a: Any, b: Any) -> bool:
    """Are two parts of results the same, to the last bit?"""
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(equal(a[key], b[key]) for key in a)
    if isinstance(a, (np.ndarray, list)) and isinstance(b, (np.ndarray, list)):
        return len(a) == len(b) and all(equal(x, y) for x, y in zip(a, b, strict=True))
    if isinstance(a, float) and isinstance(b, float):
        return a == b or (a != a and b != b)
    return bool(a == b)
