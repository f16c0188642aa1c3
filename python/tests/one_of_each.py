"""A mechanism with a parameter of every class, and its derivatives by differences."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

import flexura as fx

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


def expected_jacobian() -> np.ndarray:
    """d outputs / d parameters by differences of solves."""
    m = mechanism()

    def f(x: np.ndarray) -> np.ndarray:
        outputs = m.solve(dict(zip(CLASSES, x.tolist(), strict=True)), tolerance=1e-11).outputs
        return np.concatenate([np.atleast_1d(outputs[name]) for name in OUTPUTS])

    return differences(f, X)
