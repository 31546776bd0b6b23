"""The health card of the identification page, without a window."""

from datetime import UTC, datetime

import numpy as np
import pytest

from rotemina.app.calibration import HealthBook
from rotemina.plugins.identification.health_card import compare_health_card, store_card
from rotemina.plugins.identification.record_query import AnalysisQuestion
from rotemina.sim.calibration import SensorFigureEstimate
from rotemina.sim.excitation import StepsExcitation, excite
from rotemina.sim.records import Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate


@pytest.fixture
def question(tmp_path):
    robot = load_robot("rotemina")
    motion = excite(robot, {"zn": StepsExcitation(hold_s=0.2)}).record
    record = simulate(robot, [], motion, np.random.default_rng(1))
    return AnalysisQuestion("steps.csv", record, robot, "zn", Tap.CMD, Tap.MEAS, folder=tmp_path)


def test_the_first_card_has_no_previous_figures(question):
    findings = compare_health_card(question)
    assert findings.rows[0][0] == "gain"
    assert {row[3] for row in findings.rows} == {"–"}
    assert findings.notices[0].startswith("There is no card of this axis yet")


def test_a_card_is_compared_with_the_stored_one(question, tmp_path):
    store_card(question)
    findings = compare_health_card(question)
    assert findings.notices[0].endswith("No figure has changed beyond both intervals.")
    assert all(row[1:3] == row[3:5] for row in findings.rows)
    changed_figures = (SensorFigureEstimate("gain", 1.1, 1e-3, "1"),)
    day = datetime(2026, 11, 3, tzinfo=UTC)
    HealthBook(tmp_path, question.robot.name).add("zn", changed_figures, "it", day)
    findings = compare_health_card(question)
    assert findings.notices[0].endswith("Changed beyond both intervals: gain.")
    assert findings.rows[0][3:] == ("110 %", "0.1 %", "changed")
