"""A diagnosis as text for a terminal."""

import numpy as np
import pytest

from rotemina.sim.gap.output import make_summary_text
from rotemina.sim.gap.result import (
    AxisDiagnosis,
    Diagnosis,
    GapVerdict,
)
from rotemina.sim.messages import MessageWording
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
RECORD = Record.from_signals(
    np.arange(500) / 500.0, {("thx", Tap.CMD): np.zeros(500)}, {"thx": "rad"}
)


@pytest.fixture(scope="module")
def diagnosis(make_diagnosis):
    return make_diagnosis(lambda _: (), "thy")


def test_the_result_comes_first_and_then_the_figures_of_cause_and_size(diagnosis):
    lines = make_summary_text(diagnosis, [RECORD]).splitlines()
    assert lines[0].startswith("RoTeMiNa: ")
    text = "\n".join(lines[1:])
    assert text.index("what causes it") < text.index("how far it shrinks")
    assert "hysteresis" in text
    assert "0.91" in text


def test_a_machine_without_a_gap_has_no_causes():
    healthy = Diagnosis(ROBOT, {"thx": AxisDiagnosis("thx", GapVerdict.NONE, ())})
    text = make_summary_text(healthy, [RECORD])
    assert "no gap" in text
    assert "what causes it" not in text


def test_the_whole_text_is_in_the_requested_language(diagnosis):
    class QuotingWording(MessageWording):
        def localize_text(self, _context, template):
            return f"«{template}»"

    for line in make_summary_text(diagnosis, [RECORD], QuotingWording()).splitlines():
        assert "«" in line
