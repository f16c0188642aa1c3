"""What can go wrong, as one tree of exceptions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Self


class Problem(NamedTuple):
    """One thing that is wrong with a model or a study.

    ``path`` is the key in the words of the model file (``beam.link.length``), ``value`` the text that stands there, ``hint``
    what to write instead. ``file``, ``line`` and ``column`` are None where no file was read.
    """

    path: str
    message: str
    value: str | None = None
    hint: str | None = None
    file: str | None = None
    line: int | None = None
    column: int | None = None
    text: str | None = None

    @property
    def key(self) -> str:
        """The last word of the path."""
        return self.path.rpartition(".")[2]

    def __str__(self) -> str:
        if self.text is not None:
            return self.text
        found = f" (found {self.value})"
        if self.value is None or self.value.strip("\"'") in self.message:
            found = ""
        place = f"{self.path}: " if self.path else ""
        hint = f"\n  {self.hint}" if self.hint else ""
        return f"{place}{self.message}{found}{hint}"


class FlexuraError(Exception):
    """Everything that flexura raises by itself."""


class _Told(FlexuraError):
    """An error that knows its place."""

    def __init__(self, message: str, problems: Sequence[Problem] = ()) -> None:
        super().__init__(message)
        self.problems: tuple[Problem, ...] = tuple(problems)

    @classmethod
    def of(cls, problems: Sequence[Mapping[str, Any]], omitted: int = 0) -> Self:
        """From problems as the native part tells them."""
        list_ = [Problem(**problem) for problem in problems]
        # Of a table as a whole its name stands there, which is no value.
        list_ = [one._replace(value=None) if one.value == one.key else one for one in list_]
        texts = [str(problem) for problem in list_]
        if omitted:
            texts.append(f"... and {omitted} more")
        return cls("\n\n".join(texts), list_)

    @classmethod
    def at(cls, path: str, message: str, value: object = None, hint: str | None = None) -> Self:
        """One problem."""
        shown = None if value is None else str(value)
        return cls.of([{"path": path, "message": message, "value": shown, "hint": hint}])

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.args[0], self.problems)

    @property
    def _first(self) -> Problem:
        return self.problems[0] if self.problems else Problem("", str(self))

    @property
    def path(self) -> str:
        """Key of the first problem: ``beam.link.length``."""
        return self._first.path

    @property
    def key(self) -> str:
        """Last word of the path."""
        return self._first.key

    @property
    def value(self) -> str | None:
        """The text that stands there."""
        return self._first.value

    @property
    def hint(self) -> str | None:
        """What to write instead."""
        return self._first.hint

    @property
    def line(self) -> int | None:
        """Line in the file, from 1; None for a model that was built."""
        return self._first.line


class ModelError(_Told):
    """A model that is wrong, or a value that does not fit it."""


class StudyError(_Told):
    """A study that cannot be done, or a store that does not belong to it."""


class ConvergenceError(FlexuraError):
    """A study that did not get where it was to go; ``result`` says how far it came."""

    def __init__(self, message: str, result: Any = None) -> None:
        super().__init__(message)
        self.result = result

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.args[0], self.result)
