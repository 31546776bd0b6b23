"""A diagnosis as text for a terminal."""

import numpy as np
import pytest

from rotemina.sim.gap.diagnosis import AxisDiagnosis, Diagnosis, Verdict
from rotemina.sim.gap.output.summary import summary
from rotemina.sim.messages import Wording
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
RECORD = Record.from_signals(
    np.arange(500) / 500.0, {("thx", Tap.CMD): np.zeros(500)}, {"thx": "rad"}
)


@pytest.fixture(scope="module")
def diagnosis(make_diagnosis):
    return make_diagnosis(lambda _: (), "thy")


def test_the_answer_comes_first_and_then_cause_and_size_in_figures(diagnosis):
    lines = summary(diagnosis, [RECORD]).splitlines()
    assert lines[0].startswith("RoTeMiNa: ")
    text = "\n".join(lines[1:])
    assert text.index("what causes it") < text.index("how far it shrinks")
    assert "hysteresis" in text
    assert "0.91" in text


def test_a_machine_without_a_gap_has_no_causes_to_tell():
    quiet = Diagnosis(ROBOT, {"thx": AxisDiagnosis("thx", Verdict.NONE, ())})
    text = summary(quiet, [RECORD])
    assert "no gap" in text
    assert "what causes it" not in text


def test_all_of_it_is_said_in_the_language_that_is_asked_for(diagnosis):
    class Loud(Wording):
        def text(self, _context, template):
            return f"«{template}»"

    for line in summary(diagnosis, [RECORD], Loud()).splitlines():
        assert "«" in line
