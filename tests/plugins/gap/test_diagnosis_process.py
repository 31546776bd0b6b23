"""The process of a diagnosis, started for real: its answer, refusals, stop and death."""

import multiprocessing

import numpy as np
import pytest

from rotemina.plugins.gap.diagnosis_process import DiagnosisError, DiagnosisProcess
from rotemina.sim.errors import InputError
from rotemina.sim.gap.document import as_json
from rotemina.sim.gap.method import diagnose
from rotemina.sim.robot.file import load_robot
from rotemina.sim.simulation.simulation import simulate

ROBOT = load_robot("rotemina")


class EnoughError(Exception):
    """Nothing more is to be heard."""


@pytest.fixture
def process():
    made = DiagnosisProcess()
    yield made
    made.close()
    assert not multiprocessing.active_children()


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


def test_one_process_answers_again_and_again(process, healthy):
    process.answer(ROBOT, ["one"], [healthy], lambda _: None)
    first = multiprocessing.active_children()
    process.answer(ROBOT, ["two"], [healthy], lambda _: None)
    assert multiprocessing.active_children() == first


def test_what_cannot_be_diagnosed_is_refused_in_the_same_words(process, healthy):
    short = healthy.part(slice(0, 12))
    with pytest.raises(InputError) as here:
        diagnose(ROBOT, [short])
    with pytest.raises(InputError) as there:
        process.answer(ROBOT, ["one"], [short], lambda _: None)
    assert str(there.value) == str(here.value)
    assert process.answer(ROBOT, ["one"], [healthy], lambda _: None).diagnosis.causes == ()


def test_what_the_listener_raises_ends_the_work_and_the_process_stays(process, record, healthy):
    def until_fitting(progress):
        if progress.stage == "fitting":
            raise EnoughError

    with pytest.raises(EnoughError):
        process.answer(ROBOT, ["one"], [record], until_fitting)
    first = multiprocessing.active_children()
    assert process.answer(ROBOT, ["one"], [healthy], lambda _: None).diagnosis.causes == ()
    assert multiprocessing.active_children() == first


def test_a_process_that_dies_is_told_and_another_takes_its_place(process, record, healthy):
    def kill(progress):
        if progress.stage == "fitting":
            for child in multiprocessing.active_children():
                child.kill()

    with pytest.raises(InputError, match=r"has ended \(status -9\).*Diagnose again"):
        process.answer(ROBOT, ["one"], [record], kill)
    assert process.answer(ROBOT, ["one"], [healthy], lambda _: None).diagnosis.causes == ()


def test_a_fault_of_the_program_brings_its_traceback(process, healthy):
    with pytest.raises(DiagnosisError, match=r"Traceback[\s\S]*AttributeError"):
        process.answer(None, ["one"], [healthy], lambda _: None)
