"""Parameters from measurements, and formulas, against scipy and closed forms."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from scipy.optimize import least_squares

import flexura as fx


def bone() -> fx.Model:
    m = fx.Model("bone")
    young = m.parameter("young", "2 GPa")
    pull = m.parameter("pull", "1 N")
    thickness = m.parameter("thickness", "3.2 mm")
    material = m.material("bone", young=young, poisson=0.3)
    oval = m.section("oval", shape="ellipse", width=thickness, height="4.8 mm")
    beam = m.beam("clavicle", material=material, section=oval, length="30 mm", start=fx.clamp("ground"))
    m.load("wire", beam=beam, at=1, force=[0, pull, 0])
    m.output("tip", beam.end.displacement.y)
    return m


def table(m: fx.Model, young: list[float], noise: float) -> pd.DataFrame:
    random = np.random.default_rng(3)
    rows = []
    for name, e in zip("ABCDEFGH", young, strict=False):
        for pull in np.linspace(0.5, 6, 12):
            tip = float(m.solve(young=e, pull=pull).outputs["tip"]) + noise * random.standard_normal()
            rows.append({"pull": pull, "tip": tip * 1e3, "specimen": name})
    found = pd.DataFrame(rows)
    found.attrs["units"] = {"pull": "N", "tip": "mm"}
    return found


def test_the_estimate_and_its_error_are_those_of_scipy() -> None:
    m = bone()
    data = table(m, [2.7816e9], 2e-5).drop(columns="specimen")
    fit = m.fit(data, ["young"])
    estimate = fit.estimates["young"]

    def residuals(x: np.ndarray) -> np.ndarray:
        return np.array([float(m.solve(young=x[0] * 1e9, pull=p).outputs["tip"]) - t * 1e-3 for p, t in zip(data["pull"], data["tip"])])

    own = least_squares(residuals, [2.0], jac="3-point", x_scale="jac", xtol=1e-12, ftol=1e-12, gtol=1e-14)
    assert estimate["value"] == pytest.approx(own.x[0] * 1e9, rel=1e-6)
    jacobian: Any = own.jac
    variance = 2 * own.cost / (len(data) - 1) / float((jacobian.T @ jacobian)[0, 0])
    assert estimate["standard_error"] == pytest.approx(np.sqrt(variance) * 1e9, rel=1e-4)
    low, high = estimate["interval"]
    assert low < 2.7816e9 < high
    tip = m.solve(young=estimate["value"]).outputs["tip"]
    assert fit.fitted.solve().outputs["tip"] == pytest.approx(tip, rel=1e-12)
    assert fit.residuals["tip"] == pytest.approx(-residuals(np.array([estimate["value"] / 1e9])), abs=1e-9)
    assert list(fit.to_pandas().columns)[:2] == ["line", "pull[N]"]
    assert "young = 2.7" in repr(fit) and fit._repr_html_().startswith("<div><svg")


def test_each_specimen_has_its_own_modulus() -> None:
    m = bone()
    truth = [2.1e9, 3.4e9, 2.0e9, 2.9e9, 2.3e9]
    data = table(m, truth, 1e-5)
    fit = m.fit(data, per_specimen=["young"], noise={"tip": "0.01 mm"}, intervals="profile")
    for name, e in zip("ABCDE", truth, strict=True):
        own = fit.specimens[name]["estimates"]["young"]
        assert own["value"] == pytest.approx(e, rel=1e-2)
        assert own["profile"][0] < own["value"] < own["profile"][1]
    assert fit.spread["young"]["mean"] == pytest.approx(np.mean(truth), rel=5e-3)
    assert fit.spread["young"]["deviation"] == pytest.approx(np.std(truth, ddof=1), rel=2e-2)
    assert fit.correlation.shape == (5, 5)


def test_csv_files_and_lists_are_the_same_measurements(tmp_path: Path) -> None:
    m = bone()
    data = table(m, [2.5e9], 0.0).drop(columns="specimen")
    by_table = m.fit(data, "young").estimates["young"]["value"]
    path = tmp_path / "bone.csv"
    data.rename(columns={"pull": "pull [N]", "tip": "tip [mm]"}).to_csv(path, index=False)
    lists = {"pull [N]": data["pull"].tolist(), "tip [m]": (data["tip"] / 1e3).tolist()}
    # Another program's: semicolons, and commas for the decimals.
    comma = tmp_path / "comma.csv"
    data.rename(columns={"pull": "pull (N)", "tip": "tip (mm)"}).to_csv(comma, index=False, sep=";", decimal=",")
    for other in (path, lists, comma):
        assert m.fit(other, "young").estimates["young"]["value"] == pytest.approx(by_table, rel=1e-9)
    assert by_table == pytest.approx(2.5e9, rel=1e-6)


@pytest.mark.parametrize(
    ("data", "keys", "words"),
    [
        ({"pul [N]": [1.0], "tip [mm]": [0.1]}, {}, "neither a parameter nor an output"),
        ({"pull [m]": [1.0], "tip [mm]": [0.1]}, {}, "is a force"),
        ({"pull [N]": [1.0], "tip [mm]": [0.1]}, {"loss": "hubert"}, "there is no loss"),
        ({"pull [N]": [1.0, 2.0], "tip [mm]": [0.1, None]}, {}, "nothing was measured"),
    ],
)
def test_what_is_wrong_is_said(data: dict[str, Any], keys: dict[str, Any], words: str) -> None:
    with pytest.raises(fx.ModelError, match=words):
        bone().fit(data, "young", **keys)


def test_lists_of_different_lengths_are_refused() -> None:
    with pytest.raises(ValueError, match="not of one length"):
        bone().fit({"pull [N]": [1.0, 2.0], "tip [mm]": [0.1]}, "young")


def test_a_formula_can_be_called_and_written(tmp_path: Path) -> None:
    m = bone()
    law = m.formula("tip [mm]", "pull [N]", vary={"pull": ["0 N", "30 N", 31]}, degree=4, constant=False)
    points = law.to_pandas()
    assert law(points["pull"].to_numpy()) == pytest.approx(points["formula"].to_numpy(), rel=1e-12)
    design = np.vander(points["pull"], 5, increasing=True)[:, 1:]
    own = np.linalg.lstsq(design / np.linalg.norm(design, axis=0), points["tip"], rcond=None)[0] / np.linalg.norm(design, axis=0)
    assert list(law.pieces[0]["terms"].values()) == pytest.approx(own, rel=1e-7)
    assert law.largest_error == pytest.approx(np.abs(points["tip"] - points["formula"]).max())
    assert law.r_squared is not None and law.r_squared > 0.99999
    assert isinstance(law(pull=3.0), float)
    with pytest.raises(TypeError, match="takes pull"):
        law(push=3.0)
    for ending, words in (("h", "static inline double formula"), ("rs", "pub fn formula"), ("toml", "[[pieces]]"), ("csv", "pull^4")):
        law.write(tmp_path / f"law.{ending}")
        assert words in (tmp_path / f"law.{ending}").read_text()
    with pytest.raises(ValueError, match="name a file that ends in"):
        law.write(tmp_path / "law.m")
    program = tmp_path / "law.c"
    program.write_text('#include "law.h"\n#include <stdio.h>\nint main(void) { printf("%.17g", formula(7.0)); return 0; }\n')
    subprocess.run(["cc", "-o", str(tmp_path / "law"), str(program), "-lm"], check=True)
    printed = subprocess.run([str(tmp_path / "law")], check=True, capture_output=True, text=True).stdout
    assert float(printed) == pytest.approx(law(7.0), rel=1e-13)


def test_pieces_and_absolute_values_are_evaluated_as_they_are_fitted() -> None:
    m = bone()
    m.output("size", "abs(beam.clavicle.end.displacement.y)")
    law = m.formula(
        "size [mm]", "pull [N]", vary={"pull": ["-6 N", "6 N", 25]}, pieces=[{"to": "0 N", "degree": 2}, {"terms": ["abs(pull)", "pull^2"]}]
    )
    points = law.to_pandas()
    assert law(points["pull"].to_numpy()) == pytest.approx(points["formula"].to_numpy(), abs=1e-12)
    axes = law.plot()
    assert axes.get_xlabel() == "pull [N]"
