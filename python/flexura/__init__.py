"""Large-deflection compliant mechanisms.

>>> import flexura as fx
>>> m = fx.Model("wire")
>>> steel = m.material("steel", young="200 GPa", poisson=0.3)
>>> round = m.section("round", shape="circle", diameter="1 mm")
>>> pull = m.parameter("pull", "0.5 N")
>>> wire = m.beam("wire", material=steel, section=round, length="20 cm", start=fx.clamp("ground"))
>>> load = m.load("pull", beam=wire, at=1, force=[0, pull, 0])
>>> tip = m.output("tip", wire.end.position.y)
>>> f"{m.solve().outputs['tip']:.4f}"
'0.0997'
"""

from __future__ import annotations

import importlib
from types import ModuleType

from . import errors
from ._native import __version__, schema
from ._references import Formula, Handle, clamp, hold, pin, place, prismatic, revolute
from .control import StateSpace
from .errors import ConvergenceError, FlexuraError, ModelError, Problem, StudyError
from .fitting import Fit, ResponseFormula
from .model import Check, Model, Quantity, load, loads
from .records import Named, Record
from .result import Beam, Body, Page, Result
from .stepper import Step, Stepper
from .studies import Branch, Buckling, Frequencies, Modes, Motion, Optimum, Path, Study
from .sweep import Explanation, Sweep, sweep

__all__ = [
    "Beam",
    "Body",
    "Branch",
    "Buckling",
    "Check",
    "ConvergenceError",
    "Explanation",
    "Fit",
    "FlexuraError",
    "Formula",
    "Frequencies",
    "Handle",
    "Model",
    "ModelError",
    "Modes",
    "Motion",
    "Named",
    "Optimum",
    "Page",
    "Path",
    "Problem",
    "Quantity",
    "Record",
    "ResponseFormula",
    "Result",
    "StateSpace",
    "Step",
    "Stepper",
    "Study",
    "StudyError",
    "Sweep",
    "__version__",
    "clamp",
    "errors",
    "hold",
    "load",
    "loads",
    "pin",
    "place",
    "prismatic",
    "revolute",
    "schema",
    "sweep",
]


def __getattr__(name: str) -> ModuleType:
    """``flexura.jax`` and ``flexura.torch`` are imported where they are used, since few need them."""
    if name in ("jax", "torch"):
        return importlib.import_module(f".{name}", __name__)
    raise AttributeError(f"module 'flexura' has no attribute {name!r}")
