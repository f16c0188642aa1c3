"""Linear models, read back by scipy."""

from __future__ import annotations

from pathlib import Path

import flexura as fx
import numpy as np
import pytest

scipy_io = pytest.importorskip("scipy.io")
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


def test_scipy_finds_the_same_frequency_response(space: fx.StateSpace) -> None:
    rates = np.array([0.0, 1.0, 3.5, 10.0, 22.0, 100.0])
    _, found = scipy_signal.freqresp(space.to_scipy(), rates)
    np.testing.assert_allclose(found, space.response(rates)[:, 0, 0], rtol=1e-9)
    assert space.response(0.0)[0, 0, 0].real == pytest.approx(1 / 3, rel=1e-9)


def test_python_control_takes_the_names(space: fx.StateSpace) -> None:
    control = pytest.importorskip("control")
    system = space.to_control()
    assert isinstance(system, control.StateSpace)
    assert system.input_labels == ["load.tip.force.y"]
    np.testing.assert_allclose(system(10j), space.response(10.0)[0, 0, 0], rtol=1e-9)


def test_an_input_that_there_is_not_is_refused() -> None:
    with pytest.raises(fx.FlexuraError, match=r"load\.top"):
        fx.loads(CANTILEVER).state_space(inputs=["load.top.force.y"])
