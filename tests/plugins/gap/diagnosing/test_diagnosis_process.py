"""The real diagnosis process: its answers, refusals, stop and unexpected end."""

import os
import subprocess
import sys
import threading
from pathlib import Path
from pickle import PicklingError
from types import SimpleNamespace

import numpy as np
import pytest

from rotemina.plugins.gap.diagnosing import diagnosis_process
from rotemina.plugins.gap.diagnosing.diagnosis_process import (
    DiagnosisError,
    DiagnosisFailure,
    DiagnosisProcess,
    DiagnosisRequest,
    receive_messages,
    send_message,
)
from rotemina.sim.errors import InputError
from rotemina.sim.gap.compare import effect_candidates
from rotemina.sim.gap.fit import catalogue
from rotemina.sim.gap.output import as_json
from rotemina.sim.gap.pipeline import diagnose
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

ROBOT = load_robot("rotemina")
EFFECTS = ("gain_error", "hysteresis")
WORKER = f"""
from rotemina.plugins.gap.diagnosing.diagnosis_worker import main
from rotemina.sim.gap.compare import effect_candidates
from rotemina.sim.gap.fit import catalogue

effects = [effect for effect in catalogue() if effect.id in {EFFECTS}]
effect_candidates.catalogue = lambda: effects
main()
"""


class StopListeningError(Exception):
    """Raised by a listener that stops the diagnosis."""


@pytest.fixture
def started_processes(monkeypatch):
    """Yield the list of all started processes, and check that all of them have ended."""
    processes, popen = [], subprocess.Popen

    def start_and_note(*arguments, **options):
        processes.append(popen(*arguments, **options))
        return processes[-1]

    monkeypatch.setattr(subprocess, "Popen", start_and_note)
    yield processes
    assert all(worker.poll() is not None for worker in processes)


@pytest.fixture(autouse=True)
def few_effects(monkeypatch):
    """Search few effects here and in the process, to save time."""
    effects = [effect for effect in catalogue() if effect.id in EFFECTS]
    monkeypatch.setattr(effect_candidates, "catalogue", lambda: effects)
    monkeypatch.setattr(diagnosis_process, "_WORKER_ARGUMENTS", ("-c", WORKER))


@pytest.fixture
def process(started_processes):
    client = DiagnosisProcess()
    yield client
    client.close()


def stop_at_fitting(progress):
    if progress.stage == "fitting":
        raise StopListeningError


@pytest.fixture(scope="module")
def healthy(record):
    return simulate(ROBOT, [], record, np.random.default_rng(5))


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "SCHED_IDLE"), reason="a policy of Linux")
def test_the_process_runs_at_normal_priority_until_it_is_lowered(
    process, started_processes, healthy
):
    process.lower_priority()  # has no effect before the start
    for policy in (os.SCHED_OTHER, os.SCHED_IDLE, os.SCHED_OTHER):
        if policy == os.SCHED_IDLE:
            process.lower_priority()
        else:
            process.diagnose(ROBOT, ["record"], [healthy], lambda _: None)
        threads = [
            int(entry.name) for entry in Path(f"/proc/{started_processes[-1].pid}/task").iterdir()
        ]
        assert {os.sched_getscheduler(thread) for thread in threads} == {policy}
        assert {os.getpriority(os.PRIO_PROCESS, thread) for thread in threads} == {
            min(os.getpriority(os.PRIO_PROCESS, 0) + 10, 19)
        }
    assert len(started_processes) == 2  # the lowered process is replaced, never raised again


@pytest.mark.skipif(not hasattr(os, "SCHED_IDLE"), reason="a policy of Linux")
def test_an_ended_thread_does_not_keep_others_from_being_lowered(monkeypatch):
    calls = []

    def raise_thread_gone(thread, policy, _):
        calls.append((thread, policy))
        raise ProcessLookupError(thread)

    monkeypatch.setattr(os, "sched_setscheduler", raise_thread_gone)
    process, may_end = DiagnosisProcess(), threading.Event()
    process._process = SimpleNamespace(pid=os.getpid())
    other = threading.Thread(target=may_end.wait)
    other.start()
    process.lower_priority()
    may_end.set()
    other.join()
    assert {(os.getpid(), os.SCHED_IDLE), (other.native_id, os.SCHED_IDLE)} <= set(calls)
    earlier_calls = list(calls)
    process.lower_priority()  # the priority is already low
    assert calls == earlier_calls


def test_one_process_serves_refused_failed_stopped_and_good_requests(
    process, started_processes, record, healthy
):
    short = healthy.select_rows(slice(0, 12))
    with pytest.raises(InputError) as direct_error:
        diagnose(ROBOT, [short])
    with pytest.raises(InputError) as process_error:
        process.diagnose(ROBOT, ["one"], [short], lambda _: None)
    assert str(process_error.value) == str(direct_error.value)
    with pytest.raises(DiagnosisError, match=r"^AttributeError: ") as error:
        process.diagnose(None, ["one"], [healthy], lambda _: None)
    assert "Traceback" in error.value.__notes__[0]  # for the log only, not for the notice
    with pytest.raises(StopListeningError):
        process.diagnose(ROBOT, ["one"], [record], stop_at_fitting)

    steps = []
    answer = process.diagnose(ROBOT, ["one"], [record], steps.append)
    assert as_json(answer.diagnosis) == as_json(diagnose(ROBOT, [record]))
    assert answer.records == (record,)  # the same read-only object
    assert answer.names == ("one",)
    assert set(answer.traces) == {"thx", "thy"}
    stages = [step.stage for step in steps]
    assert {"reading", "where", "screening", "fitting", "deciding", "drawing"} <= set(stages)
    assert any(step.ranking is not None for step in steps)
    assert len(started_processes) == 1


def test_a_process_that_was_killed_or_ignores_a_stop_is_replaced(
    process, started_processes, record, healthy, monkeypatch
):
    def kill(progress):
        if progress.stage == "fitting":
            started_processes[-1].kill()

    with pytest.raises(InputError, match=r"ended \(status -9\).*diagnose again"):
        process.diagnose(ROBOT, ["one"], [record], kill)
    monkeypatch.setattr(diagnosis_process, "_END_TIMEOUT_S", 0.0)
    with pytest.raises(StopListeningError):
        process.diagnose(ROBOT, ["one"], [record], stop_at_fitting)
    assert started_processes[1].wait(20.0) is not None
    with pytest.raises((TypeError, AttributeError, PicklingError)):
        process.diagnose(lambda: None, ["one"], [healthy], lambda _: None)
    assert process.diagnose(ROBOT, ["one"], [healthy], lambda _: None).diagnosis.causes == ()
    # Nothing had been sent of the request that could not be pickled, so no process was killed.
    assert len(started_processes) == 3


def test_the_process_ends_when_its_input_is_closed(record, monkeypatch):
    monkeypatch.undo()  # here the process searches all effects
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen(
        [sys.executable, *diagnosis_process._WORKER_ARGUMENTS], **pipes
    ) as worker:
        send_message(DiagnosisRequest(1, ROBOT, ("one",), (record,)), worker.stdin)
        stages = (message.stage for message in receive_messages(worker.stdout))
        assert "screening" in stages
        worker.stdin.close()
        *_, last_message = receive_messages(worker.stdout)
        assert worker.wait(20.0) == 0
    assert last_message == DiagnosisFailure("stopped")
