"""Linear models, read back by scipy."""

from __future__ import annotations

from pathlib import Path

import flexura as fx
import numpy as np
import pytest

scipy_io = pytest.importorskip("scipy.io")
scipy_linalg = pytest.importorskip("scipy.linalg")
scipy_signal = pytest.importorskip("scipy.signal")

#: EI = rho A = L = 1 without shear and rotary inertia.
CANTILEVER = """
format = 1
name = "cantilever"
[section.strip]
shape = "stiffness"
GJ = 0.8
EI2 = 40
EI3 = 1
mass_per_length = 1
rotary_inertia = [1e-3, 0, 0]
[beam.strip]
section = "strip"
length = 1
extension = false
start = { body = "ground", hold = "clamp" }
[load.tip]
beam = "strip"
at = 1
force = [0, "1e-9 N", 0]
[output]
tip = "beam.strip.end.displacement.y"
"""

#: (beta L)^2 of the clamped bar (R. D. Blevins, Formulas for Natural Frequency and Mode Shape, 1979, table 8-1).
RATES = [3.516015268500, 22.034491564668, 61.697214413957]


@pytest.fixture(scope="module")
def space() -> fx.StateSpace:
    return fx.loads(CANTILEVER).state_space(
        6, at_rest=True, inputs=["load.tip.force.y"], outputs=["tip"], damping_ratio=0.01, residual_vectors=2
    )


def test_a_matlab_file_is_read_back_by_scipy(space: fx.StateSpace, tmp_path: Path) -> None:
    space.save(tmp_path / "space.mat")
    read = scipy_io.loadmat(tmp_path / "space.mat")
    for name in "ABCD":
        np.testing.assert_array_equal(read[name], getattr(space, name))
    assert [name.strip() for name in read["inputs"]] == ["load.tip.force.y"]
    assert [name.strip() for name in read["input_units"]] == ["N"]
    assert [name.strip() for name in read["outputs"]] == ["tip"]


def test_modes_and_residues_are_those_of_the_clamped_bar(space: fx.StateSpace) -> None:
    poles, vectors = np.linalg.eig(space.A)
    left = np.linalg.inv(vectors)
    for rate in RATES:
        wanted = complex(-0.01 * rate, rate * np.sqrt(1 - 0.01**2))
        nearest = int(np.argmin(abs(poles - wanted)))
        assert poles[nearest] == pytest.approx(wanted, rel=1e-8)
        residue = (space.C @ vectors[:, nearest])[0] * (left[nearest] @ space.B)[0]
        # The square of the tip's motion is four times the mean square of the shape.
        assert residue == pytest.approx(4 / (2j * wanted.imag), rel=1e-7)


def test_scipy_steps_it_as_its_modes_say(space: fx.StateSpace) -> None:
    times = np.linspace(0.0, 3.0, 301)
    _, found, _ = scipy_signal.lsim(space.to_scipy(), np.ones_like(times), times)
    n = len(space.A) // 2
    wanted = np.full_like(times, space.D[0, 0])
    for i in range(n):
        square, drag = -space.A[n + i, i], -space.A[n + i, n + i]
        damped = np.sqrt(square - drag**2 / 4)
        decay = np.exp(-drag * times / 2) * (np.cos(damped * times) + drag / (2 * damped) * np.sin(damped * times))
        wanted += space.C[0, i] * space.B[n + i, 0] / square * (1 - decay)
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-9 / 3)


def test_the_frequency_response_is_that_of_the_written_matrices(space: fx.StateSpace, tmp_path: Path) -> None:
    # scipy.signal.freqresp goes through polynomials, which lose the digits; the matrices themselves do not.
    space.save(tmp_path / "space.mat")
    read = scipy_io.loadmat(tmp_path / "space.mat")
    rates = np.array([0.0, 1.0, 3.5, 10.0, 22.0, 100.0])
    for rate, ours in zip(rates, space.response(rates), strict=True):
        states = scipy_linalg.solve(1j * rate * np.eye(len(read["A"])) - read["A"], read["B"])
        np.testing.assert_allclose(read["C"] @ states + read["D"], ours, rtol=1e-9)
    assert space.response(0.0)[0, 0, 0].real == pytest.approx(1 / 3, rel=1e-9)


def test_python_control_takes_the_names(space: fx.StateSpace) -> None:
    control = pytest.importorskip("control")
    system = space.to_control()
    assert isinstance(system, control.StateSpace)
    assert system.input_labels == ["load_tip_force_y"]
    np.testing.assert_allclose(system(10j), space.response(10.0)[0, 0, 0], rtol=1e-9)


def test_an_input_that_there_is_not_is_refused() -> None:
    with pytest.raises(fx.FlexuraError, match=r"load\.top"):
        fx.loads(CANTILEVER).state_space(inputs=["load.top.force.y"])


def test_residual_vectors_join_by_themselves_until_the_response_is_near() -> None:
    space = fx.loads(CANTILEVER).state_space(6, at_rest=True, inputs=["load.tip.force.y"], outputs=["tip"])
    assert space.response_error is not None
    assert 1 <= space.residual_vectors <= 3
    assert space.response_error <= 1e-6
