"""Values as the model file knows them: numbers, texts, lists and tables."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ._references import Formula, Handle
from .errors import ModelError

#: SI units in which a quantity of pint is written, by the names that pint has for them.
_UNITS = {"meter": "m", "kilogram": "kg", "second": "s", "radian": "rad", "degree_Kelvin": "K", "kelvin": "K"}


def plain(value: Any, path: str) -> Any:
    """A value of Python as a number, text, list or table. ``path`` is named where it is none of them."""
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    if isinstance(value, (int, np.integer)):
        return int(value)
    if isinstance(value, (float, np.floating)):
        return float(value)
    if isinstance(value, str):
        return str(value)
    if isinstance(value, Handle):
        return value.name
    if isinstance(value, Formula):
        return value.text
    if is_quantity(value):
        return quantity(value, path)
    if isinstance(value, Mapping):
        return table(value, path)
    if isinstance(value, np.ndarray):
        return plain(value.tolist(), path)
    if isinstance(value, Sequence):
        return [plain(item, f"{path}[{i}]") for i, item in enumerate(value)]
    if hasattr(value, "__float__"):
        return float(value)
    kind = type(value).__name__
    raise ModelError.at(
        path, f"a {kind} is no value", hint="write a number (SI), a text with a unit, a formula, a list or a dict"
    )


def table(value: Mapping[Any, Any], path: str) -> dict[str, Any]:
    """A table; keys whose value is None are left out."""
    before = f"{path}." if path else ""
    return {str(key): plain(item, f"{before}{key}") for key, item in value.items() if item is not None}


def is_quantity(value: Any) -> bool:
    """A quantity of pint, or one that looks like it."""
    return hasattr(value, "magnitude") and hasattr(value, "to_base_units")


def quantity(value: Any, path: str) -> Any:
    """A quantity of pint as text in SI units; a list of them as a list."""
    base = value.to_base_units()
    factors = []
    for name, power in base.unit_items() if hasattr(base, "unit_items") else dict(base._units).items():
        if name not in _UNITS:
            raise ModelError.at(path, f"the unit {value.units} has no meaning here", value)
        exponent = int(power) if float(power).is_integer() else float(power)
        factors.append(f"{_UNITS[name]}^{exponent}" if exponent != 1 else _UNITS[name])
    unit = "*".join(factors)

    def text(number: Any) -> Any:
        if isinstance(number, list):
            return [text(item) for item in number]
        return f"{float(number)!r} {unit}" if unit else float(number)

    magnitude = base.magnitude
    return text(magnitude.tolist() if isinstance(magnitude, np.ndarray) else magnitude)


def parameter(value: Any, path: str) -> float | str:
    """The value of a parameter: a number in SI units, or a text."""
    found = plain(value, path)
    if isinstance(found, bool) or not isinstance(found, (int, float, str)):
        raise ModelError.at(path, f"a {type(value).__name__} is no number", value, "write a number or a text with a unit")
    return found if isinstance(found, str) else float(found)


_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")


def _key(key: str) -> str:
    return key if _BARE.match(key) else _text(key)


def _text(text: str) -> str:
    escapes = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    return '"' + "".join(escapes.get(c, c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}") for c in text) + '"'


def _inline(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value) if abs(value) < 2**63 else repr(float(value))
    if isinstance(value, float):
        return "nan" if math.isnan(value) else repr(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, list):
        return "[" + ", ".join(map(_inline, value)) + "]"
    inner = ", ".join(f"{_key(key)} = {_inline(item)}" for key, item in value.items())
    return f"{{ {inner} }}" if inner else "{}"


def to_toml(tree: Mapping[str, Any]) -> str:
    """A tree as the text of a model file: the same tree is read from it."""
    lines: list[str] = []
    sections: list[str] = []
    for key, value in tree.items():
        if not isinstance(value, dict):
            lines.append(f"{_key(key)} = {_inline(value)}")
        elif value and all(isinstance(item, dict) for item in value.values()):
            for name, item in value.items():
                sections.append(_section(f"{_key(key)}.{_key(name)}", item))
        else:
            sections.append(_section(_key(key), value))
    return "\n".join(["\n".join(lines) + "\n", *sections]) if sections else "\n".join(lines) + "\n"


def _section(title: str, value: Mapping[str, Any]) -> str:
    rows = [f"{_key(key)} = {_inline(item)}" for key, item in value.items()]
    return "\n".join([f"[{title}]", *rows]) + "\n"
