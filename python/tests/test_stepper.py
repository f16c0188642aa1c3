"""Steps for loops of control."""

from __future__ import annotations

import time

import numpy as np
import pytest
from conftest import MODELS

import flexura as fx


def test_steps_find_what_solves_find() -> None:
    m = fx.load(MODELS / "lee_frame.toml")
    step = m.stepper(["load"], ["down", "angle"])
    assert step.sizes == (1, 2)
    out = np.empty(2)
    for load in np.linspace(0.1, 1.8, 18):
        status, values = step([load], out=out)
        assert status == "converged" and values is out
        solved = m.solve(load=load).outputs
        assert out == pytest.approx([solved["down"], solved["angle"]], rel=1e-6)


def test_what_does_not_converge_is_a_status() -> None:
    step = fx.load(MODELS / "lee_frame.toml").stepper(["load"], ["down"])
    assert step([1.0]).converged
    failed = step([1e9])
    assert not failed.converged and np.isnan(failed.values).all()
    assert "load" in str(step.reason)
    back = step([1.0])
    down = float(back.values[0])
    assert back.converged and str(step.reason) == "None"
    step.reset()
    assert step([1.0]).values[0] == pytest.approx(down, rel=1e-7)


def test_targets_in_unknowns_out() -> None:
    m = fx.load(MODELS / "six_rod_robot.toml")
    assert len(m.unknowns) == len(m.targets) == 6
    step = m.stepper()
    wanted = np.array(list(m.targets.values()))
    found = step(wanted)
    assert found.converged
    solved = m.solve()
    assert found.values == pytest.approx([solved.parameters[name] for name in m.unknowns], rel=1e-6)
    for fraction in (0.999, 0.998, 1.0):
        assert step(fraction * wanted).converged
    assert step.reason is None


def test_a_wrong_step_is_told() -> None:
    m = fx.load(MODELS / "lee_frame.toml")
    for inputs, outputs in (([], ["down"]), (["load"], []), (["laod"], ["down"]), (["load"], ["dwon"])):
        with pytest.raises(fx.ModelError, match="there is"):
            m.stepper(inputs, outputs)
    step = m.stepper(["load"], ["down"])
    with pytest.raises(fx.StudyError, match="go in"):
        step([1.0, 2.0])
    with pytest.raises(fx.StudyError):
        m.with_values(load=1.0).stepper(["load"], ["down"])


def test_a_warm_step_is_faster_than_a_solve() -> None:
    m = fx.load(MODELS / "compression_spring.toml")
    step = m.stepper(["push"], ["height"])
    loads = np.linspace(1.9, 2.0, 50)
    step(loads[:1])
    began = time.perf_counter()
    for load in loads:
        assert step([load]).converged
    warm = time.perf_counter() - began
    began = time.perf_counter()
    for load in loads.tolist():
        m.solve(push=load)
    assert warm < time.perf_counter() - began
