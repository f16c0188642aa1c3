"""Names of things, and formulas of what can be read off them."""

from __future__ import annotations

from typing import Any


def text_of(value: Any) -> str:
    """A value as it stands in a formula."""
    if isinstance(value, Formula):
        return value.text
    if isinstance(value, Handle):
        return value.name if value.table == "parameter" else value.path
    if isinstance(value, str):
        return value
    return repr(float(value))


def _part(value: Any, rank: int) -> str:
    """An operand, in brackets where the operator before or behind it would take it apart."""
    if isinstance(value, Formula):
        return value.text if value.rank >= rank else f"({value.text})"
    if isinstance(value, Handle):
        return text_of(value)
    if isinstance(value, str):
        return f"({value})"
    number = repr(float(value))
    return f"({number})" if number.startswith("-") else number


class _Arithmetic:
    """Sums and products of formulas, numbers (SI) and texts with a unit."""

    def __add__(self, other: Any) -> Formula:
        return Formula(f"{_part(self, 1)} + {_part(other, 1)}", 1)

    def __radd__(self, other: Any) -> Formula:
        return Formula(f"{_part(other, 1)} + {_part(self, 1)}", 1)

    def __sub__(self, other: Any) -> Formula:
        return Formula(f"{_part(self, 1)} - {_part(other, 2)}", 1)

    def __rsub__(self, other: Any) -> Formula:
        return Formula(f"{_part(other, 1)} - {_part(self, 2)}", 1)

    def __mul__(self, other: Any) -> Formula:
        return Formula(f"{_part(self, 2)} * {_part(other, 2)}", 2)

    def __rmul__(self, other: Any) -> Formula:
        return Formula(f"{_part(other, 2)} * {_part(self, 2)}", 2)

    def __truediv__(self, other: Any) -> Formula:
        return Formula(f"{_part(self, 2)} / {_part(other, 3)}", 2)

    def __rtruediv__(self, other: Any) -> Formula:
        return Formula(f"{_part(other, 2)} / {_part(self, 3)}", 2)

    def __pow__(self, other: Any) -> Formula:
        return Formula(f"{_part(self, 4)} ^ {_part(other, 4)}", 3)

    def __neg__(self) -> Formula:
        return Formula(f"-{_part(self, 3)}", 1)


class Formula(_Arithmetic):
    """A formula of the model file: ``stage.position.z - 0.15``."""

    __slots__ = ("rank", "text")

    def __init__(self, text: str, rank: int = 4) -> None:
        self.text = text
        self.rank = rank

    def __getattr__(self, name: str) -> Formula:
        if name.startswith("_") or self.rank < 4:
            raise AttributeError(f"a formula has no attribute {name!r}")
        return Formula(f"{self.text}.{name}")

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"Formula({self.text!r})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Formula) and other.text == self.text

    def __hash__(self) -> int:
        return hash(self.text)


class Handle(_Arithmetic):
    """A thing of a model. As a value it is its name; its attributes are what can be read off: ``stage.position.z``."""

    __slots__ = ("name", "table")

    def __init__(self, table: str, name: str) -> None:
        self.table = table
        self.name = name

    @property
    def path(self) -> str:
        """In the words of the file: ``body.stage``."""
        return f"{self.table}.{self.name}"

    def __getattr__(self, name: str) -> Formula:
        if name.startswith("_") or self.table == "parameter":
            raise AttributeError(f"{self.path} has no attribute {name!r}")
        return Formula(f"{self.path}.{name}")

    def __getitem__(self, at: Any) -> Formula:
        """A place on a beam: a fraction, or a text with a unit of length."""
        return Formula(f"{self.path}[{text_of(at)}]")

    def __str__(self) -> str:
        return self.name

    def __repr__(self) -> str:
        return f"<{self.path}>"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Handle) and (other.table, other.name) == (self.table, self.name)

    def __hash__(self) -> int:
        return hash((self.table, self.name))


def hold(kind: str, what: Any, /, **keys: Any) -> dict[str, Any]:
    """How a beam's end is held: ``kind`` is a word behind ``hold`` in the model file.

    ``what`` is a body or a beam, by its handle, or the name of a body or "ground". ``at`` and ``rotation`` place the frame.
    """
    if isinstance(what, Handle) and what.table == "beam":
        return {"beam": what.name, "hold": kind, **keys}
    return {"body": str(what), "hold": kind, **keys}


def clamp(what: Any, /, **keys: Any) -> dict[str, Any]:
    """An end that is held fast."""
    return hold("clamp", what, **keys)


def pin(what: Any, /, **keys: Any) -> dict[str, Any]:
    """An end that turns about its point in every direction."""
    return hold("pin", what, **keys)


def revolute(what: Any, /, **keys: Any) -> dict[str, Any]:
    """An end that turns about an axis."""
    return hold("revolute", what, **keys)


def prismatic(what: Any, /, **keys: Any) -> dict[str, Any]:
    """An end that slides along an axis."""
    return hold("prismatic", what, **keys)


def place(what: Any, /, **keys: Any) -> dict[str, Any]:
    """A frame or a point on a body or a beam, as joints and springs want it."""
    if isinstance(what, Handle) and what.table == "beam":
        return {"beam": what.name, **keys}
    return {"body": str(what), **keys}
