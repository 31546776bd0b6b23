"""Parallel jobs on a real local Dask scheduler."""

import os
import signal
import threading
from pathlib import Path

import joblib
import numpy as np
import pytest

from rotemina.app.cli.main import main
from rotemina.app.cli.terminal import prepare_workers
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap, write_record
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

pytestmark = pytest.mark.slow  # starts processes


@pytest.fixture(scope="module")
def cluster():
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0"
    ) as cluster:
        yield cluster


class Unsendable:
    """Large enough to be sent by itself, and impossible to send."""

    def __init__(self):
        self.large = bytes(10_000)

    def __sizeof__(self):
        return 10_000

    def __reduce__(self):
        raise RuntimeError("dictionary changed size during iteration")


def _do_nothing(_):
    return None


def test_job_that_cannot_be_sent_ends_the_run_with_an_error(cluster):
    with (
        prepare_workers(None, cluster.scheduler_address) as jobs,
        pytest.raises(InputError, match=r"could not be sent: .*Unsendable"),
    ):
        joblib.Parallel(n_jobs=jobs)([joblib.delayed(_do_nothing)(Unsendable())])


def test_diagnosis_continues_when_a_worker_is_killed(cluster):
    """Another worker takes over, and the result equals that of a run without a cluster."""
    robot = load_robot("rotemina")
    time_s = np.arange(2000) / 200.0
    command = 5.8e-4 + 3e-4 * np.sin(2.0 * time_s) * np.exp(-0.1 * time_s)
    commands = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    effect = AxisEffect(axis="thx", id="hysteresis")
    write_record(simulate(robot, [effect], commands, np.random.default_rng(1)), "a.csv")
    killed_pids, finished = [], []
    distributed = pytest.importorskip("distributed")

    def kill_busy_worker():
        with distributed.Client(cluster, set_as_default=False) as client:
            while not killed_pids and not finished:
                busy_workers = [address for address, keys in client.processing().items() if keys]
                if busy_workers:
                    pids = client.run(os.getpid, workers=busy_workers[:1])
                    killed_pids.extend(pids.values())
                    os.kill(killed_pids[0], signal.SIGKILL)

    killer = threading.Thread(target=kill_busy_worker)
    killer.start()
    address = cluster.scheduler_address
    try:
        status = main(["gap", "diagnose", "a.csv", "--json", "far.json", "--cluster", address])
    finally:
        finished.append(True)
        killer.join()
    assert status == 0
    assert killed_pids
    assert main(["gap", "diagnose", "a.csv", "--json", "near.json", "--jobs", "1"]) == 0
    assert Path("far.json").read_bytes() == Path("near.json").read_bytes()


def _kill_own_process(_):
    os.kill(os.getpid(), signal.SIGKILL)


def test_job_that_kills_its_worker_ends_the_run_with_an_error(cluster):
    cluster.scheduler.allowed_failures = 0  # otherwise three more workers try it first
    with (
        pytest.raises(InputError, match=r"--cluster: a worker died repeatedly"),
        prepare_workers(None, cluster.scheduler_address) as jobs,
    ):
        joblib.Parallel(n_jobs=jobs)([joblib.delayed(_kill_own_process)(1)])
