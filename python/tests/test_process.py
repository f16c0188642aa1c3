"""Signals, threads, processes, panics."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from types import FrameType

import pytest
from conftest import MODELS

import flexura as fx

LONG = """
import flexura as fx, sys, time
m = fx.load(sys.argv[1])
print("begun", flush=True)
try:
    while True:
        m.trace("load", -2, 2.5, start=0, steps=20000, most_points=100000)
except KeyboardInterrupt:
    began = time.perf_counter()
    assert m.solve().converged
    print("sound", flush=True)
"""


def test_ctrl_c_ends_a_long_study_and_leaves_the_process_sound() -> None:
    program = [sys.executable, "-c", LONG, str(MODELS / "lee_frame.toml")]
    with subprocess.Popen(program, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "begun\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "sound\n"
        assert process.wait(10) == 0


class Enough(Exception):
    pass


def test_what_a_handler_of_signals_raises_comes_through() -> None:
    def handler(_number: int, _frame: FrameType | None) -> None:
        raise Enough

    m = fx.load(MODELS / "lee_frame.toml")
    before = signal.signal(signal.SIGALRM, handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        began = time.perf_counter()
        with pytest.raises(Enough):
            while True:
                m.trace("load", -2, 2.5, start=0, steps=20000, most_points=100000)
        assert time.perf_counter() - began < 5.0
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    assert m.solve().converged


def test_other_threads_run_while_it_solves() -> None:
    m = fx.load(MODELS / "lee_frame.toml")
    ticks, stop = 0, threading.Event()

    def work() -> None:
        m.trace("load", -2, 2.5, start=0)
        stop.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not stop.wait(0.001):
        ticks += 1
    thread.join()
    assert ticks > 3


def rise(load: float) -> float:
    return float(fx.load(MODELS / "lee_frame.toml").solve(load=load).outputs["down"])


def test_threads_share_a_model() -> None:
    m = fx.load(MODELS / "lee_frame.toml")
    loads = [0.1 * i for i in range(1, 17)]
    alone = [m.solve(load=load).outputs["down"] for load in loads]
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(lambda load: m.solve(load=load).outputs["down"], loads)) == alone


def test_models_and_results_go_to_spawned_processes() -> None:
    m = fx.load(MODELS / "lee_frame.toml")
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        results = list(pool.map(fx.Model.solve, [m, m.with_values(load=1.0)]))
    assert results == [m.solve(), m.solve(load=1.0)]
