"""Many solves: spaces, executors, stores."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import time
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pandas
import pytest
from conftest import MODELS
from scipy.stats import qmc

import flexura as fx

LOADS = np.linspace(0.1, 1.5, 15)


@pytest.fixture(scope="module")
def frame() -> fx.Model:
    return fx.load(MODELS / "lee_frame.toml")


def test_a_grid_is_solved_as_sample_by_sample(frame: fx.Model) -> None:
    table = frame.sweep({"load": LOADS}, ["down", "angle"])
    assert len(table) == 15 and table.converged.all() and table.solved == 15
    expected = [frame.solve(load=load, samples=2).outputs["down"] for load in LOADS.tolist()]
    np.testing.assert_array_equal(table.outputs["down"], expected)
    assert list(table.outputs) == ["down", "angle"] and "15 samples" in repr(table)


def strip() -> fx.Model:
    m = fx.load(MODELS / "cantilever_strip.toml")
    m.output("tip", "beam.strip.end.position")
    return m


def test_spaces_of_all_kinds_give_the_same_table() -> None:
    m = strip()
    grid = m.sweep({"payload": ["10 g", "20 g", 0.03]}, ["slope", "tip"])
    kinds = [
        pandas.DataFrame({"payload": [0.01, 0.02, 0.03]}),
        [{"payload": "10 g"}, {"payload": "20 g"}, {"payload": 0.03}],
        (["payload"], np.array([[0.01], [0.02], [0.03]])),
    ]
    for kind in kinds:
        other = m.sweep(kind, ["slope", "tip"])
        np.testing.assert_allclose(other.outputs["slope"], grid.outputs["slope"], rtol=1e-12)
        np.testing.assert_allclose(other.outputs["tip"], grid.outputs["tip"], rtol=1e-10, atol=1e-15)
    sample = qmc.scale(qmc.Sobol(1, seed=0).random(8), [0.01], [0.05])
    assert m.sweep((["payload"], sample)).converged.all()


def test_a_grid_of_two_is_an_array_of_two_dimensions(frame: fx.Model) -> None:
    names = [name for name in frame.parameters if name != "load"][:1]
    value = frame.parameters[names[0]].value
    assert value is not None
    data = frame.sweep({names[0]: [value, 1.01 * value], "load": LOADS[:3]}, ["down"]).to_xarray()
    assert data["down"].shape == (2, 3) and data["down"].dims == (names[0], "load")
    assert float(data["down"][1, 2]) == frame.solve({names[0]: 1.01 * value, "load": LOADS[2]}, samples=2).outputs["down"]
    table = strip().sweep({"payload": [0.01, 0.02]}).to_pandas()
    assert {"payload", "slope", "tip.x", "status", "reason"} <= set(table.columns)
    assert table.attrs["units"]["payload"] == "kg"


def test_a_sample_that_fails_is_a_row_with_its_reason(frame: fx.Model) -> None:
    table = frame.sweep({"load": [1.0, 1.9, 1.2]}, ["down"])
    assert table.status.tolist()[0] == "converged" and table.status[1] != "converged"
    assert np.isnan(table.outputs["down"][1]) and table.reasons[1]
    wrong = strip().sweep({"payload": [0.01, -1.0]})
    assert wrong.status[0] == "converged" and len(wrong) == 2


def test_a_wrong_space_is_told(frame: fx.Model) -> None:
    with pytest.raises(fx.ModelError, match="laod"):
        frame.sweep({"laod": [1.0]})
    with pytest.raises(fx.ModelError, match="finite"):
        frame.sweep({"load": [1.0, float("nan")]})
    with pytest.raises(fx.StudyError, match="no samples"):
        frame.sweep({"load": []})
    with pytest.raises(fx.StudyError, match="no output"):
        frame.sweep({"load": [1.0]}, ["dwon"])
    with pytest.raises(fx.StudyError, match="DataFrame"):
        frame.sweep(3.0)


@pytest.mark.parametrize("kind", ["threads", "processes"])
def test_any_executor_gives_the_same_table(frame: fx.Model, kind: str) -> None:
    pool: Executor = ThreadPoolExecutor(3) if kind == "threads" else ProcessPoolExecutor(2, get_context("spawn"))
    with pool:
        table = frame.sweep({"load": LOADS}, executor=pool, chunk=4)
    np.testing.assert_array_equal(table.outputs["down"], frame.sweep({"load": LOADS}).outputs["down"])


def test_continuation_ends_at_the_same_answers(frame: fx.Model) -> None:
    near = frame.sweep({"load": LOADS}, ["down"], continuation=True, chunk=5)
    np.testing.assert_allclose(near.outputs["down"], frame.sweep({"load": LOADS}).outputs["down"], rtol=1e-6)


@pytest.mark.parametrize("ending", [".zarr", ".parquet", ".csv"])
def test_a_store_resumes_and_knows_its_model(frame: fx.Model, tmp_path: Path, ending: str) -> None:
    store = tmp_path / f"run{ending}"
    loads = [*LOADS.tolist(), 1.9]
    planned = frame.sweep({"load": loads}, ["down", "angle"], store=store, chunk=4, explain=True)
    assert planned == fx.Explanation(16, 0, 0, 16, 4, 4) and not store.exists()
    first = frame.sweep({"load": loads}, ["down", "angle"], store=store, chunk=4)
    assert first.solved == 16
    explained = frame.sweep({"load": loads}, ["down", "angle"], store=store, explain=True)
    assert (explained.samples, explained.done, explained.failed, explained.missing) == (16, 16, 1, 0)
    again = frame.sweep({"load": loads}, ["down", "angle"], store=store)
    assert again.solved == 0 and again.reasons == first.reasons
    for name in ("down", "angle"):
        np.testing.assert_array_equal(again.outputs[name], first.outputs[name])
    assert (again.status == first.status).all()
    retried = frame.sweep({"load": loads}, ["down", "angle"], store=store, retry="failed")
    assert retried.solved == 1
    np.testing.assert_array_equal(retried.outputs["down"], first.outputs["down"])
    with pytest.raises(fx.StudyError, match="tolerance"):
        frame.sweep({"load": loads}, ["down", "angle"], store=store, tolerance=1e-7)
    with pytest.raises(fx.StudyError, match="columns"):
        frame.sweep({"load": loads}, ["down"], store=store)
    with pytest.raises(fx.StudyError, match="another sweep"):
        frame.sweep({"load": [*loads[:-1], 1.8]}, ["down", "angle"], store=store)
    name = [name for name in frame.parameters if name != "load"][0]
    value = frame.parameters[name].value
    assert value is not None
    with pytest.raises(fx.StudyError, match="values"):
        frame.with_values({name: 1.1 * value}).sweep({"load": loads}, ["down", "angle"], store=store)


def test_a_place_that_is_no_store_is_left_alone(frame: fx.Model, tmp_path: Path) -> None:
    (tmp_path / "mine.csv").write_text("a,b\n")
    with pytest.raises(fx.StudyError, match="no store"):
        frame.sweep({"load": [1.0]}, store=tmp_path / "mine.csv")
    with pytest.raises(fx.StudyError, match="ends in"):
        frame.sweep({"load": [1.0]}, store=tmp_path / "run.h5")
    assert (tmp_path / "mine.csv").read_text() == "a,b\n"


def test_a_table_that_was_torn_is_mended(frame: fx.Model, tmp_path: Path) -> None:
    store = tmp_path / "run.csv"
    first = frame.sweep({"load": LOADS}, ["down"], store=store, chunk=5)
    whole = store.read_bytes()
    store.write_bytes(whole[:-30])
    again = frame.sweep({"load": LOADS}, ["down"], store=store)
    assert again.solved == 5
    np.testing.assert_array_equal(again.outputs["down"], first.outputs["down"])


KILLED = """
import sys, numpy as np, flexura as fx
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
if __name__ == "__main__":
    file, store, kind, count = sys.argv[1:]
    pool = ThreadPoolExecutor(2) if kind == "threads" else ProcessPoolExecutor(2, get_context("spawn"))
    print("begun", flush=True)
    table = fx.load(file).sweep({"push": np.linspace(1.0, 2.0, int(count))}, ["height"], store=store, executor=pool, chunk=50)
    print(table.solved, flush=True)
"""


@pytest.mark.parametrize(("kind", "ending"), [("threads", ".zarr"), ("processes", ".parquet")])
def test_ten_thousand_samples_killed_three_times(tmp_path: Path, kind: str, ending: str) -> None:
    script, store = tmp_path / "run.py", tmp_path / f"run{ending}"
    script.write_text(KILLED)
    count = 10_000
    program = [sys.executable, str(script), str(MODELS / "compression_spring.toml"), str(store), kind, str(count)]
    m, space = fx.load(MODELS / "compression_spring.toml"), {"push": np.linspace(1.0, 2.0, count)}
    done = [0]
    written: dict[str, int] = {}
    for _ in range(3):
        with subprocess.Popen(program, stdout=subprocess.PIPE, text=True, start_new_session=True) as process:
            while True:
                time.sleep(0.1)
                explained = m.sweep(space, ["height"], store=store, explain=True)
                if explained.done >= done[-1] + 300 or process.poll() is not None:
                    break
            os.killpg(process.pid, signal.SIGKILL)
        done.append(m.sweep(space, ["height"], store=store, explain=True).done)
        # What was written before is not written again.
        files = {path.name: path.stat().st_mtime_ns for path in store.glob("part-*")}
        assert all(files[name] == time_ for name, time_ in written.items())
        written = files
    assert done == sorted(done) and done[-1] < count
    found = subprocess.run(program, capture_output=True, text=True, check=True).stdout.split()
    assert int(found[-1]) == count - done[-1]
    table = m.sweep(space, ["height"], store=store)
    assert table.solved == 0 and table.converged.all()
    some = slice(0, count, 997)
    expected = [m.solve(push=push, samples=2).outputs["height"] for push in space["push"][some].tolist()]
    np.testing.assert_array_equal(table.outputs["height"][some], expected)


@pytest.mark.parametrize("ending", [".zarr", ".parquet", ".csv"])
def test_a_store_whose_beginning_was_killed_is_begun_again(frame: fx.Model, tmp_path: Path, ending: str) -> None:
    store = tmp_path / f"run{ending}"
    frame.sweep({"load": LOADS}, ["down"], store=store)
    beside = tmp_path / f".run{ending}.1.tmp"
    store.rename(beside)
    assert frame.sweep({"load": LOADS}, ["down"], store=store).solved == 15
    assert frame.sweep({"load": LOADS}, ["down"], store=store).solved == 0


def test_ctrl_c_ends_a_sweep(tmp_path: Path) -> None:
    script = tmp_path / "run.py"
    script.write_text(KILLED.replace("if __name__", "import signal\nif __name__"))
    program = [sys.executable, str(script), str(MODELS / "compression_spring.toml"), str(tmp_path / "run.csv"), "threads", "1000000"]
    with subprocess.Popen(program, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None and process.stderr is not None
        assert process.stdout.readline() == "begun\n"
        time.sleep(3.0)
        process.send_signal(signal.SIGINT)
        assert process.wait(20) != 0
        assert "KeyboardInterrupt" in process.stderr.read()


def test_a_bar_counts_samples(frame: fx.Model, capsys: pytest.CaptureFixture[str]) -> None:
    frame.sweep({"load": LOADS}, progress=True)
    assert "15/15" in capsys.readouterr().err


def test_a_table_travels(frame: fx.Model) -> None:
    table = pickle.loads(pickle.dumps(frame.sweep({"load": LOADS[:3]})))
    assert len(table) == 3 and table.converged.all()
