"""Derivatives arrive for every class of parameter, and are right."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import flexura as fx

jax = pytest.importorskip("jax")
jax.config.update("jax_enable_x64", True)
jnp = jax.numpy

#: A parameter of every class, with its value (SI).
CLASSES = {
    "length": 0.2,
    "position": 0.05,
    "rotation": 0.1,
    "material": 200e9,
    "section": 1e-3,
    "load": 0.4,
    "moment": 0.005,
    "stiffness": 3.0,
    "rest_value": 0.08,
    "law": 0.3,
    "joint_stiffness": 0.02,
    "joint_rest": 0.05,
}


def mechanism() -> fx.Model:
    m = fx.Model("one of each")
    p = {name: m.parameter(name, value) for name, value in CLASSES.items()}
    for name, unit in (("length", "m"), ("position", "m"), ("rotation", "rad"), ("material", "Pa"), ("section", "m"), ("load", "N")):
        m.set(f"parameter.{name}", f"{CLASSES[name]!r} {unit}")
    steel = m.material("steel", young=p["material"], poisson=0.3)
    wire = m.section("wire", shape="circle", diameter=p["section"])
    turned = {"axis": [0, 0, 1], "angle": p["rotation"]}
    stage = m.body("stage", at=["0.2 m", p["position"], 0])
    leaf = m.beam("leaf", material=steel, section=wire, length=p["length"], start=fx.clamp("ground", rotation=turned), end=fx.clamp(stage))
    m.spring("straight", from_=fx.place("ground", at=[0.2, -0.1, 0.02]), to=fx.place(stage), stiffness=p["stiffness"], rest_length=p["rest_value"])
    m.spring("toe", from_=fx.place("ground", at=[0.3, 0.1, 0]), to=fx.place(leaf, at=0.6), law="toe", axial_stiffness=p["law"], toe_strain=0.05, rest_length=0.1)
    arm = m.body("arm", at=["0.2 m", p["position"], 0])
    m.joint("hinge", kind="revolute", parent=stage, child=arm, axis=[0, 0, 1], stiffness=p["joint_stiffness"], rest=p["joint_rest"])
    m.load("push", body=stage, force=[0, p["load"], "0.1 N"])
    m.load("turn", body=arm, moment=[0, 0, p["moment"]])
    m.output("stage", stage.position)
    m.output("hinge", "joint.hinge.coordinate")
    m.output("energy", "spring.straight.tension")
    return m


def differences(f: Callable[[np.ndarray], np.ndarray], x: np.ndarray) -> np.ndarray:
    """Central differences of order six."""
    columns = []
    for i, value in enumerate(x):
        h = 2e-3 * value
        step = np.eye(len(x))[i] * h
        weights = {1: 3 / 4, 2: -3 / 20, 3: 1 / 60}
        columns.append(sum(w * (f(x + j * step) - f(x - j * step)) for j, w in weights.items()) / h)
    return np.array(columns).T


X = np.array(list(CLASSES.values()))
OUTPUTS = ["stage", "hinge", "energy"]


@pytest.fixture(scope="module")
def expected() -> np.ndarray:
    m = mechanism()

    def f(x: np.ndarray) -> np.ndarray:
        outputs = m.solve(dict(zip(CLASSES, x.tolist(), strict=True)), tolerance=1e-11).outputs
        return np.concatenate([np.atleast_1d(outputs[name]) for name in OUTPUTS])

    return differences(f, X)


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


def test_torch_gets_the_same_gradient(expected: np.ndarray) -> None:
    torch = pytest.importorskip("torch")
    f = fx.torch.function(mechanism(), list(CLASSES), OUTPUTS)
    x = torch.tensor(X, dtype=torch.float64, requires_grad=True)
    jacobian = torch.autograd.functional.jacobian(f, x).numpy()
    scale = np.abs(expected).max(axis=0)
    np.testing.assert_allclose(jacobian / scale, expected / scale, atol=1e-6)
    f(x).sum().backward()
    np.testing.assert_allclose(x.grad.numpy() / scale, expected.sum(axis=0) / scale, atol=1e-5)


def test_a_model_for_gradients_travels() -> None:
    assert pickle.loads(pickle.dumps(mechanism())).solve() == mechanism().solve()
