"""Every bundled model: read, solved, written, read again."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest
from conftest import MODELS

import flexura as fx

FILES = sorted(MODELS.glob("*.toml"))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_model_written_anew_gives_the_same_answers(file: Path) -> None:
    model = fx.load(file)
    first = model.solve(check=False)
    # From nested dicts, so that every table and value is written by the package and read again.
    rebuilt = fx.Model.from_dict(model.to_dict(), folder=file.parent)
    again = fx.loads(rebuilt.to_toml(), folder=file.parent)
    assert again.to_dict() == model.to_dict()
    second = again.solve(check=False)
    assert second.status == first.status
    assert max(first.difference(second).values(), default=0.0) <= 1e-12


@pytest.mark.parametrize("file", FILES[::6], ids=lambda file: file.stem)
def test_models_and_results_travel(file: Path) -> None:
    model = fx.load(file)
    result = model.solve(check=False)
    copy = pickle.loads(pickle.dumps(model))
    assert copy == model and copy.key == model.key and copy.to_toml() == model.to_toml()
    travelled = pickle.loads(pickle.dumps(result))
    assert travelled == result and travelled.status == result.status
    assert max(result.difference(travelled).values(), default=0.0) == 0.0


def test_the_text_of_a_file_is_kept_until_it_is_changed() -> None:
    file = MODELS / "cantilever_strip.toml"
    model = fx.load(file)
    assert model.to_toml() == file.read_text(encoding="utf-8")
    model.parameter("extra", "2 N")
    assert "extra" in model.to_toml() and fx.loads(model.to_toml(), folder=MODELS) == model


def test_included_files_are_taken_into_the_model(tmp_path: Path) -> None:
    (tmp_path / "steel.toml").write_text('format = 1\n[material.steel]\nyoung = "200 GPa"\npoisson = 0.3\n')
    (tmp_path / "rod.toml").write_text(
        'format = 1\ninclude = "steel.toml"\n[section.rod]\nshape = "circle"\ndiameter = "1 mm"\n'
        '[beam.rod]\nmaterial = "steel"\nsection = "rod"\nlength = "50 mm"\nstart = { body = "ground", hold = "clamp" }\n'
    )
    model = fx.load(tmp_path / "rod.toml")
    assert "include" not in model.to_toml()
    assert fx.loads(model.to_toml()).to_dict() == model.to_dict()


def test_a_model_with_points_in_a_file_finds_them_beside_it(tmp_path: Path) -> None:
    (tmp_path / "axis.csv").write_text("0,0,0\n0.05,0,0\n0.1,0,0\n0.15,0,0\n")
    m = fx.Model.from_dict({"format": 1, "name": "bent"}, folder=tmp_path)
    m.section("rod", shape="stiffness", EA=float("inf"), GJ=1, EI2=1, EI3=1)
    m.beam("rod", section="rod", curve={"kind": "points", "file": "axis.csv"}, start=fx.clamp("ground"))
    m.load("push", beam="rod", at=1, force=[0, 1, 0])
    m.output("tip", "beam.rod.end.position.y")
    m.save(tmp_path / "bent.toml")
    tip = m.solve().outputs["tip"]
    # F L³ / 3 EI, to the second order of the slope.
    assert tip == pytest.approx(0.15**3 / 3, rel=1e-3)
    assert fx.load(tmp_path / "bent.toml").solve().outputs["tip"] == tip
    assert fx.loads(m.to_toml(), folder=tmp_path).solve().outputs["tip"] == tip
