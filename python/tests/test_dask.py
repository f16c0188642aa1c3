"""Sweeps on Dask: worker processes over TCP, one of which is killed in the middle."""

from __future__ import annotations

import os
import signal
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import MODELS

import flexura as fx

distributed = pytest.importorskip("distributed")

COUNT = 6000


def parts(store: Path) -> dict[str, int]:
    """The chunks of a store, with when each was written."""
    return {path.name: path.stat().st_mtime_ns for path in store.glob("part-*")}


def test_a_killed_worker_loses_no_sample_and_repeats_only_those_in_flight(tmp_path: Path) -> None:
    m = fx.load(MODELS / "compression_spring.toml")
    space = {"push": np.linspace(1.0, 2.0, COUNT)}
    store, chunk = tmp_path / "run.parquet", 100
    options: dict[str, Any] = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": None, "protocol": "tcp://"}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
        pids = client.run(os.getpid)
        assert len(set(pids.values())) == 2 and os.getpid() not in pids.values()
        killed: list[int] = []
        written: dict[str, int] = {}

        def kill() -> None:
            until = time.monotonic() + 60.0
            while time.monotonic() < until:
                time.sleep(0.02)
                if m.sweep(space, ["height"], store=store, explain=True).done >= 5 * chunk:
                    written.update(parts(store))
                    victim = next(iter(pids.values()))
                    os.kill(victim, signal.SIGKILL)
                    killed.append(victim)
                    return

        killer = threading.Thread(target=kill)
        killer.start()
        table = m.sweep(space, ["height"], store=store, executor=client.get_executor(), chunk=chunk)
        killer.join()
    assert killed and table.converged.all()
    # What stood in the store when the worker was killed was not solved again.
    after = parts(store)
    assert len(written) >= 5 and all(after[name] == when for name, when in written.items())
    assert m.sweep(space, ["height"], store=store).solved == 0
    some = slice(0, COUNT, 599)
    expected = [m.solve(push=push, samples=2).outputs["height"] for push in space["push"][some].tolist()]
    np.testing.assert_array_equal(table.outputs["height"][some], expected)
