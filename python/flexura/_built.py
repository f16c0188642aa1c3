"""What a model is made of: the tables of a model file, built by keywords, and what can be told of them."""

from __future__ import annotations

import copy
import hashlib
import json
import os
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from keyword import iskeyword
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, NamedTuple, Self

from . import _native, _values
from ._references import Handle, text_of
from .errors import ModelError

if TYPE_CHECKING:
    from ._tables import Tables
else:

    class Tables:
        """The tables of the model file as methods; ``_tables.pyi`` lists them with their keys."""


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


class Built(Tables):
    """The tables of a model file and values of its parameters: what a :class:`flexura.Model` is without its studies."""

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
        if not isinstance(other, Built):
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

    def _given(self, parameters: Mapping[str, Any] | None, values: Mapping[str, Any]) -> dict[str, float | str]:
        both = {**(parameters or {}), **values}
        return {str(name): _values.parameter(value, f"parameter.{name}") for name, value in both.items()}

    def _all(self, parameters: Mapping[str, Any] | None, values: Mapping[str, Any]) -> list[tuple[str, float | str]]:
        if not (parameters or values):
            return list(self._values.items())
        return list({**self._values, **self._given(parameters, values)}.items())
