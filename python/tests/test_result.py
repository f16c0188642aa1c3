"""What an equilibrium gives."""

from __future__ import annotations

import copy
import pickle

import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import MODELS

import flexura as fx


@pytest.fixture(scope="module")
def strip() -> fx.Result:
    return fx.load(MODELS / "cantilever_strip.toml").solve()


def test_arrays_are_those_of_the_document(strip: fx.Result) -> None:
    beam, written = strip.beams["strip"], strip.document["beams"]["strip"]
    assert beam.position.shape == (101, 3) and beam.rotation.shape == (101, 4) and beam.s.shape == (101,)
    assert beam.keys() == {key for key in written if written[key] is not None}
    for key in beam:
        np.testing.assert_array_equal(beam[key], written[key])
    assert beam.position is strip.beams["strip"].position
    assert strip.outputs == dict(strip.document["outputs"])
    assert dict(strip.parameters) == dict(strip.document["parameters"])


def test_the_strip_sags_as_measured_elsewhere(strip: fx.Result) -> None:
    # Mattiasson's elliptic integrals for P L²/EI of this strip and tip weight, as the verification page has them.
    assert strip.outputs["x_over_length"] == pytest.approx(0.841_075_234, abs=1e-7)


def test_samples_and_tolerance_are_options(strip: fx.Result) -> None:
    few = strip.model.solve(samples=5, tolerance=1e-6)
    assert len(few.beams["strip"].s) < 12
    assert few.outputs["x_over_length"] == pytest.approx(strip.outputs["x_over_length"], abs=1e-5)


def test_a_result_is_a_table(strip: fx.Result) -> None:
    table = strip.to_pandas()
    assert len(table) == 101 and table.attrs["units"]["position.x"] == "m"
    np.testing.assert_array_equal(table["position.x"], strip.beams["strip"].position[:, 0])
    data = strip.to_xarray()
    assert data["strip.position"].attrs["units"] == "m" and data["strip.position"].dims == ("strip.s", "component")
    assert float(data["slope"]) == strip.outputs["slope"] and data["slope"].attrs["units"] == "rad"


def test_a_result_shows_itself(strip: fx.Result) -> None:
    assert repr(strip).startswith("<flexura.Result 'cantilever strip': converged, stable\n  x_over_length = 0.841075")
    shown = strip._repr_html_()
    assert "<svg" in shown and "x_over_length" in shown
    page = strip.page()
    assert page._repr_html_().startswith("<iframe srcdoc=") and page.html.lstrip().lower().startswith("<!doctype html")


def test_a_shape_in_a_plane_is_drawn_in_it(strip: fx.Result) -> None:
    axes = strip.plot(color="k")
    x, z = axes.lines[0].get_data()
    np.testing.assert_array_equal(x, strip.beams["strip"].position[:, 0])
    np.testing.assert_array_equal(z, strip.beams["strip"].position[:, 2])
    assert axes.get_xlabel() == "x / m" and axes.get_ylabel() == "z / m"
    spring = fx.load(MODELS / "compression_spring.toml").solve()
    assert spring.plot().name == "3d"
    robot = fx.load(MODELS / "four_bar.toml").solve()
    assert len(robot.plot().lines) >= 2
    plt.close("all")


def test_a_mesh_has_the_samples(strip: fx.Result) -> None:
    pyvista = pytest.importorskip("pyvista")
    mesh = strip.to_pyvista()
    assert isinstance(mesh, pyvista.PolyData) and mesh.n_points > 0
    assert np.ptp(mesh.points[:, 0]) == pytest.approx(np.ptp(strip.beams["strip"].position[:, 0]), rel=0.05)


def test_results_compare_and_travel(strip: fx.Result) -> None:
    assert strip == strip.model.solve()
    other = strip.model.solve(payload="20 g")
    assert strip != other and max(strip.difference(other).values()) > 0.1
    travelled = pickle.loads(pickle.dumps(other))
    assert travelled == other and travelled.model == other.model
    np.testing.assert_array_equal(travelled.beams["strip"].moment, other.beams["strip"].moment)
    assert travelled.to_vtp() == other.to_vtp()
    assert copy.deepcopy(other) == other


def test_a_solve_may_start_at_an_earlier_result(strip: fx.Result) -> None:
    near = strip.model.solve(payload="50.1 g", start=strip)
    far = strip.model.solve(payload="50.1 g")
    assert near.outputs["slope"] == pytest.approx(far.outputs["slope"], rel=1e-7)
    assert near.document["work"]["newton_steps"] < far.document["work"]["newton_steps"]


def test_what_did_not_converge_is_kept() -> None:
    model = fx.load(MODELS / "shallow_arch.toml")
    path = next(iter(model.parameters))
    with pytest.raises(fx.ConvergenceError) as caught:
        for factor in (1.0, 3.0, 10.0, 100.0):
            model.solve({path: factor * (model.parameters[path].value or 1.0)})
    result = caught.value.result
    assert result.status != "converged" and result.reason and result.reason in str(caught.value)
    assert result.beams and 0.0 <= result.load_fraction < 1.0
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.result.status == result.status
    assert not model.solve(result.model.values, check=False).converged


def test_an_output_without_a_value_says_why() -> None:
    m = fx.load(MODELS / "cantilever_strip.toml")
    m.output("nothing", "1 / (beam.strip.start.position.x * 0)")
    result = m.solve()
    assert "nothing" not in result.outputs and "nothing" in result.output_reasons
    assert any("nothing" in warning for warning in result.warnings)


def test_compliance_of_a_place_is_symmetric() -> None:
    m = fx.load(MODELS / "cantilever_strip.toml")
    compliance = m.solve(compliances=["beam.strip.end"]).compliance["beam.strip.end"]
    assert compliance.shape == (6, 6)
    # Maxwell and Betti, about the loaded state under a dead weight.
    np.testing.assert_allclose(compliance, compliance.T, atol=1e-7 * np.abs(compliance).max())
    with pytest.raises(fx.StudyError, match="did you mean `strip`"):
        m.solve(compliances=["beam.strap.end"])


def test_several_equilibria_are_found_by_their_energy() -> None:
    m = fx.load(MODELS / "bistable_beam.toml")
    found = m.equilibria(guesses=10, seed=1)
    assert found and all(result.converged for result in found)
    energies = [result.energy for result in found]
    assert energies == sorted(energies)
