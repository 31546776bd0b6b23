"""The process of a diagnosis, started for real: its answer, refusals, stop and death."""

import os
import subprocess
import sys
import threading
from pathlib import Path
from pickle import PicklingError
from types import SimpleNamespace

import numpy as np
import pytest

from rotemina.plugins.gap import diagnosis_process
from rotemina.plugins.gap.diagnosis_process import (
    DiagnosisError,
    DiagnosisProcess,
    Failure,
    Request,
    read,
    write,
)
from rotemina.sim.errors import InputError
from rotemina.sim.gap.diagnosis_pipeline import diagnose
from rotemina.sim.gap.output.document import as_json
from rotemina.sim.robot.file import load_robot
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


class EnoughError(Exception):
    """Nothing more is to be heard."""


@pytest.fixture
def started(monkeypatch):
    """Every process that was started; none is left in the end."""
    made, popen = [], subprocess.Popen

    def note(*given, **options):
        made.append(popen(*given, **options))
        return made[-1]

    monkeypatch.setattr(subprocess, "Popen", note)
    yield made
    assert all(one.poll() is not None for one in made)


@pytest.fixture
def process(started):
    made = DiagnosisProcess()
    yield made
    made.close()


@pytest.fixture(scope="module")
def healthy(record):
    return simulate(ROBOT, [], record, np.random.default_rng(5))


def test_it_answers_what_the_diagnosis_itself_does(process, record):
    steps = []
    answer = process.answer(ROBOT, ["one"], [record], steps.append)
    assert as_json(answer.diagnosis) == as_json(diagnose(ROBOT, [record]))
    assert answer.records == (record,)  # itself, which nobody can write to
    assert answer.names == ("one",)
    assert set(answer.traces) == {"thx", "thy"}
    stages = [one.stage for one in steps]
    assert {"reading", "where", "screening", "fitting", "deciding", "drawing"} <= set(stages)
    assert any(one.ranking is not None for one in steps)


@pytest.mark.slow
def test_one_process_answers_again_and_again(process, started, healthy):
    for name in ("one", "two"):
        assert process.answer(ROBOT, [name], [healthy], lambda _: None).names == (name,)
    assert len(started) == 1


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "SCHED_IDLE"), reason="a policy of Linux")
def test_it_has_its_share_of_the_cores_until_the_machine_moves(process, started, healthy):
    process.stand_back()  # there is none yet
    for policy in (os.SCHED_OTHER, os.SCHED_IDLE, os.SCHED_OTHER):
        if policy == os.SCHED_IDLE:
            process.stand_back()
        else:
            process.answer(ROBOT, ["record"], [healthy], lambda _: None)
        threads = [int(one.name) for one in Path(f"/proc/{started[-1].pid}/task").iterdir()]
        assert {os.sched_getscheduler(thread) for thread in threads} == {policy}
        assert {os.getpriority(os.PRIO_PROCESS, one) for one in threads} == {
            min(os.getpriority(os.PRIO_PROCESS, 0) + 10, 19)
        }
    assert len(started) == 2  # none is raised again


@pytest.mark.skipif(not hasattr(os, "SCHED_IDLE"), reason="a policy of Linux")
def test_a_thread_that_ends_while_it_stands_back_spares_no_other(monkeypatch):
    asked = []

    def gone(thread, policy, _):
        asked.append((thread, policy))
        raise ProcessLookupError(thread)

    monkeypatch.setattr(os, "sched_setscheduler", gone)
    process, goes_on = DiagnosisProcess(), threading.Event()
    process._process = SimpleNamespace(pid=os.getpid())
    other = threading.Thread(target=goes_on.wait)
    other.start()
    process.stand_back()
    goes_on.set()
    other.join()
    assert {(os.getpid(), os.SCHED_IDLE), (other.native_id, os.SCHED_IDLE)} <= set(asked)
    before = list(asked)
    process.stand_back()  # it does already
    assert asked == before


def test_what_cannot_be_diagnosed_is_refused_in_the_same_words(process, healthy):
    short = healthy.part(slice(0, 12))
    with pytest.raises(InputError) as here:
        diagnose(ROBOT, [short])
    with pytest.raises(InputError) as there:
        process.answer(ROBOT, ["one"], [short], lambda _: None)
    assert str(there.value) == str(here.value)
    assert process.answer(ROBOT, ["one"], [healthy], lambda _: None).diagnosis.causes == ()


@pytest.mark.slow
def test_what_the_listener_raises_ends_the_work_and_the_process_stays(
    process, started, record, healthy
):
    def until_fitting(progress):
        if progress.stage == "fitting":
            raise EnoughError

    with pytest.raises(EnoughError):
        process.answer(ROBOT, ["one"], [record], until_fitting)
    assert process.answer(ROBOT, ["one"], [healthy], lambda _: None).diagnosis.causes == ()
    assert len(started) == 1


def test_a_process_that_dies_is_told_and_another_takes_its_place(process, started, record, healthy):
    def kill(progress):
        if progress.stage == "fitting":
            started[-1].kill()

    with pytest.raises(InputError, match=r"ended \(status -9\).*diagnose again"):
        process.answer(ROBOT, ["one"], [record], kill)
    assert process.answer(ROBOT, ["one"], [healthy], lambda _: None).diagnosis.causes == ()


@pytest.mark.slow
def test_a_fault_of_the_program_brings_its_traceback(process, healthy):
    with pytest.raises(DiagnosisError, match=r"^AttributeError: ") as fault:
        process.answer(None, ["one"], [healthy], lambda _: None)
    assert "Traceback" in fault.value.__notes__[0]  # in the log, not in the notice


def test_what_cannot_be_sent_leaves_the_process_as_it_was(process, started, healthy):
    with pytest.raises((TypeError, AttributeError, PicklingError)):
        process.answer(lambda: None, ["one"], [healthy], lambda _: None)
    assert process.answer(ROBOT, ["one"], [healthy], lambda _: None).diagnosis.causes == ()


def test_a_process_that_does_not_heed_a_stop_is_ended(process, started, record, monkeypatch):
    monkeypatch.setattr(diagnosis_process, "_PATIENCE_S", 0.0)

    def until_fitting(progress):
        if progress.stage == "fitting":
            raise EnoughError

    with pytest.raises(EnoughError):
        process.answer(ROBOT, ["one"], [record], until_fitting)
    assert started[0].wait(20.0) is not None


def test_the_process_ends_with_whoever_started_it(record):
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen([sys.executable, *diagnosis_process._WORKER], **pipes) as worker:
        write(Request(1, ROBOT, ("one",), (record,)), worker.stdin)
        stages = (message.stage for message in read(worker.stdout))
        assert "fitting" in stages  # it is at work
        worker.stdin.close()
        *_, last = read(worker.stdout)
        assert worker.wait(20.0) == 0
    assert last == Failure("stopped")
