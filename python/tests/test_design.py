"""Design optimisation against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import MODELS

import flexura as fx

#: Of small deflections: h = (4 F L³/(E b w))^(1/3).
THICKNESS = (4 * 0.125 * 0.2**3 / (200e9 * 0.02 * 1e-4)) ** (1 / 3)


def test_the_lightest_cantilever_is_that_of_small_deflections() -> None:
    m = fx.load(MODELS / "lightest_cantilever.toml")
    best = m.run("light")
    assert isinstance(best, fx.Optimum)
    assert best.parameters["thickness"] == pytest.approx(THICKNESS, rel=1e-6)
    assert best.active == ["output.sag.most"]
    typed = m.optimise(
        {"thickness": ("0.5 mm", "6 mm")}, minimise="model.mass", constraints=[{"output": "sag", "most": "0.1 mm"}], starts=2
    )
    assert typed.objective == pytest.approx(best.objective, rel=1e-8)
    assert len(typed.starts) == 2 and len(typed.to_pandas()) > 2
    assert typed.best_model().solve().outputs["sag"] == pytest.approx(1e-4, rel=1e-6)
    assert "thickness = 0.00215" in repr(best) and best._repr_html_().startswith("<div><svg")


def test_a_front_has_the_product_of_small_deflections() -> None:
    front = fx.load(MODELS / "lightest_cantilever.toml").run("front")
    assert isinstance(front, fx.Optimum)
    product = [point["objective"] ** 3 * point["other"] for point in front.front]
    assert len(product) == 9 and np.ptp(product) < 1e-4 * product[0]


def test_what_cannot_be_met_raises_with_the_nearest_design() -> None:
    m = fx.load(MODELS / "lightest_cantilever.toml")
    with pytest.raises(fx.ConvergenceError, match="infeasible") as told:
        m.optimise({"thickness": ("0.5 mm", "6 mm")}, minimise="model.mass", constraints=[{"output": "sag", "most": "1 um"}])
    nearest = told.value.result
    assert isinstance(nearest, fx.Optimum)
    assert nearest.parameters["thickness"] == pytest.approx(6e-3)
