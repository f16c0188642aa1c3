"""What must be refused, with place and hint."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import pytest
from conftest import MODELS

import flexura as fx
from flexura import _native

WRONG = MODELS / "wrong"
FILES = sorted(file for file in WRONG.glob("*.toml") if file.with_suffix(".expected").is_file())


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_wrong_file_is_refused_as_by_the_command(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(WRONG)
    with pytest.raises(fx.ModelError) as caught:
        # What describes no solvable mechanism is found where it is first used.
        fx.load(file.name).check()
    expected = file.with_suffix(".expected").read_text(encoding="utf-8").strip()
    assert str(caught.value).strip() == expected
    error = pickle.loads(pickle.dumps(caught.value))
    assert (error.path, error.hint, error.line) == (caught.value.path, caught.value.hint, caught.value.line)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_the_same_mistake_by_keywords_has_the_same_path_and_hint(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(WRONG)
    with pytest.raises(fx.ModelError) as caught:
        fx.load(file.name).check()
    of_file = caught.value
    tree = _native.tree(file.read_text(encoding="utf-8", errors="replace"))
    if not is_said_by_keywords(file, tree):
        pytest.skip("what is wrong is the text, not what it says")
    with pytest.raises(fx.ModelError) as caught:
        fx.Model.from_dict(tree).check()
    by_words = caught.value
    assert by_words.line is None
    # Where a file is named, a model of keywords is `model`.
    places = [(problem.path, problem.hint, problem.message) for problem in by_words.problems]
    known = [(problem.path, (problem.hint or "").replace(file.name, "model") or None, problem.message) for problem in of_file.problems]
    assert places == known or set(places) == set(known)


def is_said_by_keywords(file: Path, tree: dict[str, Any]) -> bool:
    """Mistakes of TOML itself, and dates, cannot be made by keywords."""
    text = file.with_suffix(".expected").read_text(encoding="utf-8")
    of_the_text = ("TOML", "found a date", "duplicate", "given twice", "quotes", "the file is empty", "larger than", "nested too deep")
    return bool(tree) and not any(words in text for words in of_the_text) and "format" in tree


def test_the_skipped_files_are_few() -> None:
    skipped = [file for file in FILES if not is_said_by_keywords(file, _native.tree(file.read_text(encoding="utf-8")))]
    assert len(skipped) < 0.15 * len(FILES)


def wire() -> fx.Model:
    m = fx.Model("wire")
    m.material("steel", young="200 GPa", poisson=0.3)
    m.section("round", shape="circle", diameter="1 mm")
    m.beam("wire", material="steel", section="round", length="20 cm", start=fx.clamp("ground"))
    return m


BY_KEYWORDS: list[tuple[str, dict[str, Any], str, str]] = [
    ("material", {"yung": "3 GPa"}, "material.x.yung", "young"),
    ("material", {"young": "3 GPa", "poisson": 0.7}, "material.x.poisson", "0.5"),
    ("material", {"young": "3 GPa", "poisson": "1 mm"}, "material.x.poisson", ""),
    ("section", {"shape": "circel", "diameter": "1 mm"}, "section.x.shape", "circle"),
    ("section", {"shape": "circle", "diameter": True}, "section.x.diameter", ""),
    ("section", {"shape": "circle", "diameter": [1, 2]}, "section.x.diameter", ""),
    ("load", {"beam": "wier", "at": 1, "force": [0, 1, 0]}, "load.x.beam", "wire"),
    ("load", {"beam": "wire", "at": 2, "force": [0, 1, 0]}, "load.x.at", ""),
    ("load", {"beam": "wire", "at": 1, "force": [0, 1]}, "load.x.force", ""),
    ("load", {"beam": "wire", "at": 1, "force": [0, "puhs", 0]}, "load.x.force[1]", ""),
    ("output", {}, "output.x", "m.output"),
    ("joint", {"kind": "hinge", "parent": "ground", "child": "ground"}, "joint.x.kind", ""),
    ("body", {"at": [0, 0, "1 N"]}, "body.x.at[2]", ""),
    ("beam", {"material": "steel", "section": "round", "length": -1, "start": fx.clamp("ground")}, "beam.x.length", ""),
    ("beam", {"material": "steel", "section": "round", "length": 1, "start": fx.hold("glue", "ground")}, "beam.x.start.hold", ""),
]


@pytest.mark.parametrize(("table", "keys", "path", "hint"), BY_KEYWORDS)
def test_a_mistake_in_a_keyword_names_its_path(table: str, keys: dict[str, Any], path: str, hint: str) -> None:
    with pytest.raises(fx.ModelError) as caught:
        m = wire()
        m.add(table, "x", **keys)
        m.check()
    assert any(problem.path == path for problem in caught.value.problems), caught.value
    assert hint in str(caught.value)
    assert caught.value.line is None


def test_a_value_that_is_none_names_its_path() -> None:
    with pytest.raises(fx.ModelError) as caught:
        wire().load("x", beam="wire", at=1, force=[0, object(), 0])
    assert caught.value.path == "load.x.force[1]" and caught.value.hint
    m = wire()
    m.parameter("push", "1 N")
    for value, words in (("1 m", "force"), (float("nan"), "finite"), ([1], "list"), ("1 Nn", "Nn")):
        with pytest.raises(fx.ModelError, match=words) as caught:
            m.load("x", beam="wire", at=1, force=[0, "push", 0]) if "x" not in m.to_dict().get("load", {}) else None
            m.solve(push=value)
        assert caught.value.path in ("parameter.push", "load.x.force[1]")


def test_the_same_name_twice_is_refused() -> None:
    with pytest.raises(fx.ModelError, match="already") as caught:
        wire().material("steel", young=1)
    assert caught.value.path == "material.steel"


def test_a_file_that_is_not_there_is_an_error_of_the_machine(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        fx.load(tmp_path / "none.toml")
    with pytest.raises((OSError, fx.ModelError)):
        fx.load(tmp_path)


def test_what_is_loose_is_named() -> None:
    m = wire()
    m.body("stage", at=(0, 0, 1))
    with pytest.raises(fx.ModelError) as caught:
        m.check()
    assert caught.value.path == "body.stage"
    assert caught.value.hint


def test_the_name_of_a_table_that_lacks_a_key_is_no_value() -> None:
    m = fx.Model()
    m.beam("b", length=1)
    with pytest.raises(fx.ModelError, match="`section` is missing") as caught:
        m.solve()
    assert (caught.value.path, caught.value.value) == ("beam.b", None) and "found" not in str(caught.value)
