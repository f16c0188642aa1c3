"""Paths, critical loads, motions, inverse problems, derivatives."""

from __future__ import annotations

import pickle

import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import MODELS

import flexura as fx


@pytest.fixture(scope="module")
def frame() -> fx.Path:
    return fx.load(MODELS / "lee_frame.toml").trace("load", -2.0, 2.5, start=0)


def test_the_folds_of_lees_frame(frame: fx.Path) -> None:
    # Lee, Manuel and Rossow (1968).
    assert [fold.parameter for fold in frame.folds] == pytest.approx([1.85567, -0.94144], abs=1e-5)
    assert frame.converged and frame.parameter == "load" and len(frame.branches) == 1


def test_a_path_is_a_table_and_a_picture(frame: fx.Path) -> None:
    table = frame.to_pandas()
    assert len(table) == len(frame.branches[0]) and table["kind"].eq("fold").sum() == 2
    np.testing.assert_array_equal(table["down"], frame.branches[0].output("down"))
    axes = frame.plot("down")
    points = {look: sum(np.size(line.get_data()[0]) for line in axes.lines if line.get_linestyle() == look) for look in ("-", "--")}
    assert min(points.values()) > 2
    drawn = sum(points.values())
    assert drawn >= len(frame.branches[0])
    plt.close("all")
    assert "<svg" in frame._repr_html_() and "2 folds" in repr(frame)
    assert pickle.loads(pickle.dumps(frame)) == frame


def test_a_key_of_a_study_is_a_keyword() -> None:
    model = fx.load(MODELS / "lee_frame.toml")
    path = model.trace("load", 0, 2.5, event=["output.down = 20"])
    assert path.events[0].outputs["down"] == pytest.approx(20.0, abs=1e-6)
    with pytest.raises(fx.ModelError) as caught:
        model.trace("load", 0, 2.5, evnt="output.down = 20")
    assert caught.value.path == "study.trace.evnt" and "event" in (caught.value.hint or "")
    with pytest.raises(fx.ModelError) as caught:
        model.trace("laod", 0, 2.5)
    assert caught.value.hint == "did you mean `load`?"


def column() -> fx.Model:
    m = fx.Model("column")
    m.section("rod", shape="stiffness", EA=float("inf"), GJ=1, EI2=1, EI3=2)
    push = m.parameter("push", "1 N")
    rod = m.beam("rod", section="rod", length=1, start=fx.clamp("ground"))
    m.load("push", beam=rod, at=1, force=[-push, 0, 0])
    m.output("side", rod.end.position.z)
    return m


def test_critical_loads_are_eulers() -> None:
    found = column().buckle("push", count=2)
    # π²EI/(4L²), about e2 and about e3.
    assert sorted(found.values) == pytest.approx([np.pi**2 / 4, np.pi**2 / 2], rel=1e-7)
    assert "critical at" in repr(found) and len(found.modes) == 2


def test_natural_frequencies_are_those_of_a_bar() -> None:
    m = column()
    m.set("section.rod.mass_per_length", 1.0)
    found = m.modes(4, at_rest=True)
    # (βL)² √(EI/ρA L⁴), about e2 and about e3.
    beta = np.array([1.875104068711961, 4.694091132974175])
    wanted = np.sort(np.concatenate([beta**2, beta**2 * np.sqrt(2.0)])) / (2 * np.pi)
    assert found.frequencies == pytest.approx(wanted, rel=1e-9)
    assert np.all(found.growth == 0) and found.effective_masses.shape == (4, 6)
    assert list(found.to_pandas()["kind"]) == ["swinging"] * 4
    assert "Hz" in repr(found)


def test_damped_modes_have_damping_ratios() -> None:
    model = fx.load(str(MODELS / "beck_column.toml"))
    found = model.modes(2, at_rest=True, parameters={"damping": 0.01})
    # s² + ω² (1 + γ s) = 0 for each ω of the undamped cantilever.
    omega = np.array([1.875104068711961, 4.694091132974175]) ** 2
    assert found.damping_ratios == pytest.approx(0.005 * omega, rel=1e-8)
    assert found.growth == pytest.approx(-0.005 * omega**2, rel=1e-8)


def test_the_onset_of_flutter_is_found_along_a_path() -> None:
    model = fx.load(str(MODELS / "beck_column.toml"))
    found = model.frequencies("push", 5, 25, count=3)
    (onset,) = found.onsets()
    # M. Beck, ZAMP 3 (1952) 225.
    assert onset["kind"] == "flutter" and onset["begins"]
    assert onset["parameter"] == pytest.approx(20.050953619, rel=1e-9)


def test_branches_are_followed() -> None:
    path = column().trace("push", 0, 4, branches=1)
    assert path.branch_points[0].parameter == pytest.approx(np.pi**2 / 4, rel=1e-8)
    assert len(path.branches) >= 2


def test_a_critical_point_is_followed_in_a_second_parameter() -> None:
    m = column()
    stiffness = m.parameter("stiffness", 1.0)
    m.set("section.rod.EI2", stiffness)
    path = m.trace("push", 0, 6, critical={"parameter": stiffness, "range": [1.0, 1.5]})
    assert path.critical is not None and len(path.critical["points"]) > 2
    for point in path.critical["points"]:
        assert point["parameter"] == pytest.approx(np.pi**2 / 4 * point["second_parameter"], rel=1e-6)


@pytest.mark.parametrize("file", sorted(MODELS.glob("*.toml")), ids=lambda file: file.stem)
def test_studies_of_the_files_are_run_by_name(file: object) -> None:
    model = fx.load(str(file))
    quick = [name for name, kind in model.studies.items() if kind in ("solve", "buckle", "inverse_dynamics")]
    for name in quick:
        found = model.run(name)
        assert found.status == "converged" and found.to_json() and repr(found)
    with pytest.raises(fx.StudyError, match="no study"):
        model.run("none such")


def test_a_motion_in_time_has_its_outputs_over_time() -> None:
    for file in sorted(MODELS.glob("*.toml")):
        model = fx.load(file)
        motions = [name for name, kind in model.studies.items() if kind == "inverse_dynamics"]
        if motions:
            motion = model.run(motions[0])
            assert isinstance(motion, fx.Motion)
            table = motion.to_pandas()
            assert len(table) == len(motion.times) > 2
            assert np.all(np.diff(motion.times) >= 0)
            return
    raise AssertionError("no model moves")


def test_a_parameter_is_found_so_that_a_target_is_met() -> None:
    m = fx.load(MODELS / "cantilever_strip.toml")
    wanted = m.solve(payload="100 g").outputs["slope"]
    m.unknown("payload", guess="120 g")
    m.target("output.slope", wanted)
    found = m.solve()
    assert found.parameters["payload"] == pytest.approx(0.1, rel=1e-7)
    assert m.unknowns == ["payload"] and m.targets == {"output.slope": wanted}
    # The derivative of what is found by what is wanted has the sign of the sag.
    others = [name for name in m.parameters if name != "payload"]
    if others:
        found.jacobian(["parameter.payload"], others[:1])
    with pytest.raises(fx.StudyError, match="unknown"):
        found.jacobian(["slope"], ["payload"])


def test_derivatives_agree_with_differences() -> None:
    m = fx.load(MODELS / "cantilever_strip.toml")
    m.output("tip", "beam.strip.end.position")
    r = m.solve(tolerance=1e-11)
    h = 1e-4 * r.parameters["payload"]
    above, below = (m.solve(payload=r.parameters["payload"] + step, tolerance=1e-11) for step in (h, -h))
    slope = (above.outputs["slope"] - below.outputs["slope"]) / (2 * h)
    tip = (above.outputs["tip"] - below.outputs["tip"]) / (2 * h)
    jacobian = r.jacobian(["slope", "tip"], ["payload"])
    assert jacobian.shape == (4, 1)
    assert jacobian[0, 0] == pytest.approx(slope, rel=1e-6)
    np.testing.assert_allclose(jacobian[1:, 0], tip, rtol=1e-5, atol=1e-9)
    assert r.sensitivity("slope", "payload") == jacobian[0, 0]
    pulled = r.vjp({"slope": 2.0, "tip": [0.0, 0.0, 1.0]}, ["payload"])
    assert pulled["payload"] == pytest.approx(2 * jacobian[0, 0] + jacobian[3, 0], rel=1e-12)
    assert r.jacobian().shape == (sum(np.size(value) for value in r.outputs.values()), len(r.parameters))
    for outputs, parameters in ((["slop"], ["payload"]), (["slope"], ["paylod"])):
        with pytest.raises(fx.StudyError, match="there is no"):
            r.jacobian(outputs, parameters)
