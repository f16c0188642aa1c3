"""Derivatives arrive for every class of parameter, and are right."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest
from one_of_each import CLASSES, OUTPUTS, X, expected_jacobian, mechanism

import flexura as fx

jax = pytest.importorskip("jax")
jax.config.update("jax_enable_x64", True)
jnp = jax.numpy

@pytest.fixture(scope="module")
def expected() -> np.ndarray:
    return expected_jacobian()


@pytest.mark.parametrize("name", CLASSES)
def test_the_gradient_of_a_class_arrives(name: str, expected: np.ndarray) -> None:
    m = mechanism()
    i = list(CLASSES).index(name)
    column = expected[:, i]
    assert np.abs(column).max() > 0.0, "the example depends on it"
    of_result = m.solve(tolerance=1e-10).jacobian(OUTPUTS, [name])[:, 0]
    f = fx.jax.function(m, [name], OUTPUTS)
    reverse = jax.jacrev(f)(X[[i]])[:, 0]
    _, forward = jax.jvp(f, (jnp.array(X[[i]]),), (jnp.ones(1),))
    for found in (of_result, reverse, forward):
        np.testing.assert_allclose(found, column, rtol=1e-6, atol=1e-6 * np.abs(column).max())


def test_a_function_composes_maps_and_compiles(expected: np.ndarray) -> None:
    m = mechanism()
    f = fx.jax.function(m, list(CLASSES), OUTPUTS)
    jacobian = jax.jacrev(f)(X)
    scale = np.abs(expected).max(axis=0)
    np.testing.assert_allclose(jacobian / scale, expected / scale, atol=1e-6)

    def objective(x: Any) -> Any:
        return jnp.sum((f(x)[:2] - 0.1) ** 2)

    y = f(X)
    gradient = jax.jit(jax.grad(objective))(X)
    np.testing.assert_allclose(gradient / scale, 2 * (y[:2] - 0.1) @ jacobian[:2] / scale, rtol=1e-9, atol=1e-12)
    batch = jnp.array([X, 1.01 * X])
    np.testing.assert_array_equal(jax.vmap(f)(batch)[1], f(1.01 * X))
    gradients = jax.vmap(jax.grad(objective))(batch)
    np.testing.assert_array_equal(gradients[0], jax.grad(objective)(X))


def test_a_wrong_name_or_shape_is_told() -> None:
    m = mechanism()
    for parameters, outputs in ((["lenght"], OUTPUTS), (["length"], ["stag"])):
        with pytest.raises(fx.StudyError, match="there is no"):
            fx.jax.function(m, parameters, outputs)
    with pytest.raises(ValueError, match="expected an array"):
        fx.jax.function(m, ["length"], OUTPUTS)(X)
    nowhere = fx.jax.function(column(), ["push"], ["side"], failed="nan")
    assert np.isnan(nowhere(jnp.array([1e12]))).all()
    with pytest.raises(Exception, match="ConvergenceError: column: iteration_limit"):
        fx.jax.function(column(), ["push"], ["side"])(jnp.array([1e12])).block_until_ready()


def column() -> fx.Model:
    m = fx.Model("column")
    m.section("rod", shape="stiffness", EA=float("inf"), GJ=1, EI2=1, EI3=2)
    push = m.parameter("push", "1 N")
    rod = m.beam("rod", section="rod", length=1, start=fx.clamp("ground"))
    m.load("push", beam=rod, at=1, force=[-push, 0, "0.1 N"])
    m.output("side", rod.end.position.z)
    return m


def test_what_is_found_has_a_gradient_by_what_is_given() -> None:
    m = column()
    m.parameter("wanted", "0.05 m")
    m.unknown("push", guess="1 N")
    m.target("beam.rod.end.position.z", "wanted")
    f = fx.jax.function(m, ["wanted"], ["parameter.push"])
    h = 1e-5
    difference = (f(jnp.array([0.05 + h])) - f(jnp.array([0.05 - h]))) / (2 * h)
    found = jax.jacfwd(f)(jnp.array([0.05]))
    np.testing.assert_allclose(found[:, 0], difference, rtol=1e-5)


def test_a_model_for_gradients_travels() -> None:
    assert pickle.loads(pickle.dumps(mechanism())).solve() == mechanism().solve()
