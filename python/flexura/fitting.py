"""Parameters from measurements, and formulas that repeat a model's answer."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from .records import Array, Record
from .studies import Study

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes


def measurements(data: Any) -> Any:
    """A table of measurements as a study takes it: of a CSV file, a DataFrame, or lists by names of columns.

    Names of columns bear units, ``"pull [N]"``, or a DataFrame has them in ``attrs["units"]``. NaN and None are empty cells.
    """
    if isinstance(data, (str, os.PathLike)):
        return os.path.abspath(os.fspath(data))
    if isinstance(data, Mapping) and {"columns", "rows"} == set(data):
        return data
    units: Mapping[str, str] = getattr(data, "attrs", {}).get("units", {})
    names = [str(name) for name in (data.columns if hasattr(data, "columns") else data)]
    columns = [_cells(data[name]) for name in (data.columns if hasattr(data, "columns") else data)]
    lengths = {name: len(column) for name, column in zip(names, columns, strict=True)}
    if len(set(lengths.values())) > 1:
        raise ValueError(f"the columns of the measurements are not of one length: {lengths}")
    headed = [f"{name} [{units[name]}]" if units.get(name) and "[" not in name else name for name in names]
    return {"columns": headed, "rows": [list(row) for row in zip(*columns, strict=True)]}


def _cells(values: Iterable[Any]) -> list[Any]:
    def cell(value: Any) -> Any:
        if value is None or value != value:
            return ""
        return value if isinstance(value, str) else float(value)

    return [cell(value) for value in values]


class Fit(Study):
    """Parameters found from measurements."""

    @property
    def estimates(self) -> Record:
        """By name ``.value``, ``.standard_error``, ``.interval`` and so on, SI: what is the same for all specimens."""
        return Record(self.document["estimates"])

    @property
    def specimens(self) -> Record:
        """By name ``.estimates``, ``.distance`` (more than 1: outside what the others predict) and ``.is_rejected``."""
        return Record(self.document.get("specimens", {}))

    @property
    def spread(self) -> Record:
        """Over the specimens that count, of what each has its own value: ``.mean``, ``.deviation``, ``.count``."""
        return Record(self.document.get("spread", {}))

    @cached_property
    def correlation(self) -> Array:
        """Correlations between the estimates (n, n), in the order of ``correlated``; NaN of those that are not determined."""
        rows = [[np.nan if value is None else value for value in row] for row in self.document["correlation"]]
        return np.array(rows, dtype=float)

    @property
    def correlated(self) -> list[str]:
        """What the rows of ``correlation`` are."""
        return list(self.document["correlated"])

    @cached_property
    def residuals(self) -> dict[str, Array]:
        """Measured less computed by output, one for each row, SI; NaN where there is nothing to compare."""
        found = self.document["residuals"]
        return {name: np.array([np.nan if v is None else v for v in values]) for name, values in found.items()}

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each row of the measurements: what it sets, measured, computed, residual, SI."""
        import io

        import pandas

        return pandas.read_csv(io.StringIO(self.files["residuals.csv"]))

    @property
    def fitted(self) -> Any:
        """The model with the estimates that are the same for all specimens."""
        return self.model.with_values({name: entry["value"] for name, entry in self.document["estimates"].items()})

    def __repr__(self) -> str:
        found = ", ".join(f"{name} = {entry['value']:.6g} {entry['unit']}" for name, entry in self.document["estimates"].items())
        found = found or ", ".join(f"{name} = {s['mean']:.6g} ± {s['deviation']:.2g}" for name, s in self.spread.items())
        return f"<flexura.Fit {self.model.name!r}: {self.status}, {found}>"


class ResponseFormula(Study):
    """A polynomial that repeats an output. It can be called: ``law(theta=0.3)``, in the units of the study."""

    @property
    def variables(self) -> list[str]:
        """What goes in, in order."""
        return list(self.document["variables"])

    @property
    def pieces(self) -> list[Record]:
        """One after another: ``.range``, ``.terms`` with their coefficients, ``.r_squared``, ``.largest_error``."""
        return [Record(piece) for piece in self.document["pieces"]]

    @property
    def r_squared(self) -> float | None:
        """1 - Σ error²/Σ (value - mean)²."""
        found: float | None = self.document["r_squared"]
        return found

    @property
    def largest_error(self) -> float:
        """Largest error at the points, in the output's unit."""
        return float(self.document["largest_error"])

    def __call__(self, *values: Any, **named: Any) -> Any:
        """The formula's value, for numbers or arrays, by place or by name."""
        names = self.variables
        if len(values) > len(names):
            raise TypeError(f"{len(values)} values for {', '.join(names)}")
        given = dict(zip(names, values, strict=False)) | named
        if set(given) != set(names):
            raise TypeError(f"the formula takes {', '.join(names)}")
        at = {name: np.asarray(value, dtype=float) for name, value in given.items()}
        first = at[names[0]]
        found = np.full(np.broadcast_shapes(*(value.shape for value in at.values())), np.nan)
        pieces = self.document["pieces"]
        for i, piece in enumerate(pieces):
            after = True if i == 0 else first > piece["range"][0]
            before = True if i + 1 == len(pieces) else first <= piece["range"][1]
            value = sum(coefficient * _term(term, at) for term, coefficient in piece["terms"].items())
            found = np.where(np.logical_and(after, before), value, found)
        return found if found.ndim else float(found)

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each point: what went in, the model's value, the formula's."""
        import pandas

        table = pandas.DataFrame(dict(self.document["points"]))
        table[self.document["output"]] = self.document["values"]
        table["formula"] = self.document["formula"]
        return table

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the formula as ``.toml``, ``.csv``, ``.h`` (C) or ``.rs`` (Rust)."""
        ending = os.path.splitext(os.fspath(path))[1]
        text = self.files.get(f"formula{ending}")
        if text is None:
            raise ValueError(f"cannot tell how to write {os.fspath(path)!r}: name a file that ends in .toml, .csv, .h or .rs")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """The model's points and the formula over the first variable."""
        from matplotlib import pyplot

        drawn = axes or pyplot.subplots()[1]
        name = self.variables[0]
        x = np.asarray(self.document["points"][name])
        drawn.plot(x, self.document["values"], ".", label="model", **style)
        order = np.argsort(x)
        drawn.plot(x[order], np.asarray(self.document["formula"])[order], "-" if len(self.variables) == 1 else "x", label="formula")
        unit = self.document["variables"][name]["unit"]
        drawn.set_xlabel(f"{name} [{unit}]" if unit else name)
        drawn.set_ylabel(f"{self.document['output']} [{self.document['unit']}]" if self.document["unit"] else self.document["output"])
        drawn.legend()
        return drawn

    def __repr__(self) -> str:
        return (
            f"<flexura.ResponseFormula {self.document['output']} of {', '.join(self.variables)}: "
            f"{self.status}, R² = {self.r_squared}, largest error {self.largest_error:.3g}>"
        )


def _term(text: str, at: Mapping[str, Array]) -> Any:
    """The value of a product of powers: ``theta^2*abs(psi)``."""
    value: Any = 1.0
    if text == "1":
        return value
    for factor in text.split("*"):
        base, _, power = factor.partition("^")
        name = base.removeprefix("abs(").removesuffix(")")
        own = np.abs(at[name]) if base != name else at[name]
        value = value * own ** int(power or 1)
    return value
