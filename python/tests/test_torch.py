"""The same derivatives by PyTorch, where that is installed."""

from __future__ import annotations

import numpy as np
import pytest
from one_of_each import CLASSES, OUTPUTS, X, expected_jacobian, mechanism

import flexura as fx


def test_torch_gets_the_same_gradient() -> None:
    torch = pytest.importorskip("torch")
    expected = expected_jacobian()
    f = fx.torch.function(mechanism(), list(CLASSES), OUTPUTS)
    x = torch.tensor(X, dtype=torch.float64, requires_grad=True)
    jacobian = torch.autograd.functional.jacobian(f, x).numpy()
    scale = np.abs(expected).max(axis=0)
    np.testing.assert_allclose(jacobian / scale, expected / scale, atol=1e-6)
    f(x).sum().backward()
    np.testing.assert_allclose(x.grad.numpy() / scale, expected.sum(axis=0) / scale, atol=1e-5)
