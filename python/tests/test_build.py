"""Models built by keywords."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Any

import numpy as np
import pint
import pytest
from conftest import CHECKOUT

import flexura as fx


def wire(**keys: object) -> fx.Model:
    m = fx.Model("wire", **keys)
    steel = m.material("steel", young="200 GPa", poisson=0.3)
    section = m.section("round", shape="circle", diameter="1 mm")
    pull = m.parameter("pull", "0.5 N")
    wire = m.beam("wire", material=steel, section=section, length="20 cm", start=fx.clamp("ground"))
    m.load("pull", beam=wire, at=1, force=[0, pull, 0])
    m.output("tip", wire.end.position)
    m.output("rise", wire.end.position.y)
    return m


FILE = """
format = 1
name = "wire"
[material.steel]
young = "200 GPa"
poisson = 0.3
[section.round]
shape = "circle"
diameter = "1 mm"
[parameter]
pull = "0.5 N"
[beam.wire]
material = "steel"
section = "round"
length = "20 cm"
start = { body = "ground", hold = "clamp" }
[load.pull]
beam = "wire"
at = 1
force = [0, "pull", 0]
[output]
tip = "beam.wire.end.position"
rise = "beam.wire.end.position.y"
"""


def test_keywords_make_the_tree_of_the_file() -> None:
    built, read = wire(), fx.loads(FILE)
    assert built == read and built.key == read.key
    assert built.solve() == read.solve()
    assert fx.loads(built.to_toml()) == built


def test_every_table_of_the_format_is_a_method() -> None:
    of_all = {"format", "name", "gravity", "include", "mass_damping", "spin"}
    tables = set(json.loads(fx.schema())["properties"]) - of_all
    m = fx.Model("whirl", mass_damping="2 1/s", spin={"rate": "3 rad/s"})
    assert "mass_damping" in m.to_toml() and "spin" in m.to_toml()
    assert all(callable(getattr(m, table)) for table in tables)
    assert tables <= set(dir(m))
    with pytest.raises(AttributeError):
        m.no_such_table  # noqa: B018


def test_the_stub_of_the_tables_is_up_to_date() -> None:
    subprocess.run([sys.executable, str(CHECKOUT / "python/tables.py"), "--check"], check=True)


def test_values_may_be_numbers_texts_quantities_arrays_and_formulas() -> None:
    units: Any = pint.UnitRegistry()
    reference = wire().solve(pull="0.25 N").outputs["rise"]
    assert wire().solve(pull=0.25).outputs["rise"] == reference
    assert wire().solve({"pull": np.float32(0.25)}).outputs["rise"] == reference
    assert wire().solve(pull=units.Quantity(250, "mN")).outputs["rise"] == pytest.approx(reference, rel=1e-12)
    m = wire()
    m.set("beam.wire.length", units.Quantity(0.2, "meter"))
    m.set("material.steel.young", units.Quantity(200, "GPa"))
    m.set("load.pull.force", np.array([0.0, 0.25, 0.0]) * units.newton)
    assert m.solve().outputs["rise"] == pytest.approx(reference, rel=1e-12)
    pull = m.handle("parameter.pull")
    m.set("load.pull.force", [0, pull / 2, 0])
    assert m.solve().outputs["rise"] == pytest.approx(reference, rel=1e-12)
    with pytest.raises(fx.ModelError, match="pressure"):
        m.solve(pull=units.Quantity(1, "Pa"))
    with pytest.raises(fx.ModelError, match="unit"):
        m.set("beam.wire.length", units.Quantity(1, "ampere"))


def test_formulas_keep_the_order_of_operations() -> None:
    m = fx.Model()
    a, b = m.parameter("a", 2.0), m.parameter("b", 3.0)
    formulas = {
        "sum": (a + b * 2, 8.0),
        "difference": (1 - (a - b), 2.0),
        "product": ((a + b) * -2, -10.0),
        "quotient": (a / (b / 2), 4 / 3),
        "power": ((a + 1) ** 2, 9.0),
        "minus": (-(a**2) - -b, -1.0),
    }
    for name, (formula, _) in formulas.items():
        m.parameter(name, formula)
    m.material("steel", young="200 GPa", poisson=0.3)
    m.section("round", shape="circle", diameter="1 mm")
    m.beam("wire", material="steel", section="round", length="20 cm", start=fx.clamp("ground"))
    for name, (_, value) in formulas.items():
        assert m.parameters[name].value == pytest.approx(value, rel=1e-15), name


def test_a_beam_may_hold_a_beam_and_a_body_a_beam() -> None:
    m = wire()
    beam = m.handle("beam.wire")
    stage = m.body("stage", at=[0.2, 0.1, 0])
    m.beam("second", material="steel", section="round", length="0.1 m", start=fx.clamp(beam, at=1), end=fx.pin(stage))
    tree = m.to_dict()["beam"]["second"]
    assert tree["start"] == {"beam": "wire", "hold": "clamp", "at": 1}
    assert tree["end"] == {"body": "stage", "hold": "pin"}
    assert str(stage.position.z - "1 mm") == "body.stage.position.z - (1 mm)"
    assert str(beam[0.5].position.y) == "beam.wire[0.5].position.y"
    assert str(beam["30 mm"].stress) == "beam.wire[30 mm].stress"


def test_check_counts_unknowns_against_equations() -> None:
    check = wire().check()
    assert check.is_square and sum(check.unknowns.values()) > 0
    assert "unknowns" in str(check)
    m = wire()
    m.parameter("unused", "1 N")
    assert any("unused" in warning for warning in m.check().warnings)


def test_a_model_says_what_it_is() -> None:
    m = wire()
    assert repr(m) == "<flexura.Model 'wire': 1 beam, 1 load, 1 parameter, 2 output>"
    assert m.parameters["pull"] == (0.5, "N") and m.outputs == {"tip": "m", "rise": "m"}
    other = m.with_values(pull="1 N")
    assert other != m and other.key != m.key and other.solve() == m.solve(pull="1 N")
    m.set("beam.wire.length", "10 cm")
    assert m.solve().outputs["rise"] < wire().solve().outputs["rise"]


def test_odd_names_and_texts_survive_the_file() -> None:
    m = fx.Model('quotes " and \\ and\nlines\t\x07')
    assert fx.loads(m.to_toml() + "\n[parameter]\na = 1\n" + wire_text()).name == m.name


def wire_text() -> str:
    return "\n".join(line for line in FILE.splitlines() if not line.startswith(("format", "name", "[parameter]", "pull ="))).replace(
        '"pull"', "1"
    )
