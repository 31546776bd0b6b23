"""The health card as the identification page shows it, without a window."""

from datetime import UTC, datetime

import numpy as np
import pytest

from rotemina.app.calibration.health_book import HealthBook
from rotemina.plugins.identification.health_card import health_findings, keep_card
from rotemina.plugins.identification.record_query import Question
from rotemina.sim.calibration.sensor_calibration import Figure
from rotemina.sim.excitation.generator import excite
from rotemina.sim.excitation.staircase_steps_prbs import Steps
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.simulation.simulation import simulate


@pytest.fixture
def question(tmp_path):
    robot = load_robot("rotemina")
    motion = excite(robot, {"zn": Steps(hold_s=0.2)}).record
    record = simulate(robot, [], motion, np.random.default_rng(1))
    return Question("steps.csv", record, robot, "zn", Tap.CMD, Tap.MEAS, folder=tmp_path)


def test_the_first_card_has_no_last_time(question):
    found = health_findings(question)
    assert found.rows[0][0] == "gain"
    assert {row[3] for row in found.rows} == {"–"}
    assert found.notices[0].startswith("There is no card of this axis yet")


def test_a_kept_card_is_the_last_one(question, tmp_path):
    keep_card(question)
    found = health_findings(question)
    assert found.notices[0].endswith("No figure has changed beyond both intervals.")
    assert all(row[1:3] == row[3:5] for row in found.rows)
    other = (Figure("gain", 1.1, 1e-3, "1"),)
    day = datetime(2026, 11, 3, tzinfo=UTC)
    HealthBook(tmp_path, question.robot.name).add("zn", other, "it", day)
    found = health_findings(question)
    assert found.notices[0].endswith("Changed beyond both intervals: gain.")
    assert found.rows[0][3:] == ("110 %", "0.1 %", "changed")
