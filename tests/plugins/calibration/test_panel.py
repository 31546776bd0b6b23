"""The sensor calibration panel: plan, run, store a result and switch it on and off."""

import numpy as np
import pytest

from rotemina.app.calibration import CalibrationPlaybackPhase, CalibrationPlaybackState
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.calibration.words import describe_progress, has_iso_cycles
from rotemina.sim.calibration import make_calibration_motion
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.simulation import simulate

LONG_MS = 30_000


@pytest.fixture
def panel(make_robot_window):
    return make_robot_window("rotemina").panels["calibration"]


def _select_axis(panel, axis):
    panel.procedure.axis.setCurrentIndex(panel.procedure.axis.findData(axis))


def _simulate_calibration_record(robot, error):
    motion = make_calibration_motion(robot, "zn", runs=3, rate_hz=500.0)
    effect = AxisEffect(axis="zn", id="sensor_gain", parameters={"error": error})
    return simulate(robot, [effect], motion, np.random.default_rng(1))


def _fit_record(qtbot, panel, record):
    panel.calibration = None
    panel.fit_record("zn.csv", record)
    qtbot.waitUntil(lambda: panel.calibration is not None, timeout=LONG_MS)


def test_a_planned_calibration_is_fitted_stored_and_switched_off(qtbot, panel):
    workbench, procedure = panel.workbench, panel.procedure
    corrections = workbench.session.corrections
    _select_axis(panel, "zn")
    assert not procedure.targets.isEnabled()  # a piezo axis has no ISO 230-2 cycles
    qtbot.waitUntil(lambda: "there is no plan" in procedure.run.toolTip(), timeout=LONG_MS)
    procedure.plan.click()
    qtbot.waitUntil(lambda: procedure.run.isEnabled(), timeout=LONG_MS)
    assert "5 runs, triangles and moves" in procedure.status_label.text()
    procedure.runs.setValue(4)  # the plan no longer fits the settings
    qtbot.waitUntil(lambda: not procedure.run.isEnabled(), timeout=LONG_MS)

    _fit_record(qtbot, panel, _simulate_calibration_record(workbench.robot, 0.0))
    assert panel.result.verdict.text().startswith("Refused: zn")
    assert not panel.result.store.isEnabled()

    _fit_record(qtbot, panel, _simulate_calibration_record(workbench.robot, 0.02))
    assert panel.result.figures.item(1, 0).text() == "gain error"
    assert panel.result.figures.item(1, 1).text().startswith(("2 %", "1.99", "2.00"))
    panel.result.store.click()
    qtbot.waitUntil(lambda: panel.stored.stored != (), timeout=LONG_MS)
    (stored_calibration,) = panel.stored.stored
    assert stored_calibration.on
    assert corrections.names == {"zn": stored_calibration.calibration.name}
    assert not panel.result.store.isEnabled()

    panel.stored.table.selectRow(0)
    panel.stored.switch_off_button.click()
    qtbot.waitUntil(lambda: corrections.names == {}, timeout=LONG_MS)
    qtbot.waitUntil(lambda: panel.stored.use_button.isEnabled(), timeout=LONG_MS)


def test_a_run_requested_during_motion_waits_and_is_stopped_while_waiting_or_playing(
    qtbot, panel, monkeypatch
):
    session, procedure = panel.workbench.session, panel.procedure
    _select_axis(panel, "zn")
    procedure.plan.click()
    qtbot.waitUntil(procedure.run.isEnabled, timeout=LONG_MS)
    plan_text = procedure.status_label.text()
    monkeypatch.setattr(type(session), "at_rest", False)
    procedure.run.click()
    qtbot.waitUntil(procedure.stop.isEnabled, timeout=LONG_MS)
    procedure.stop.click()
    qtbot.waitUntil(lambda: procedure.status_label.text() == plan_text, timeout=LONG_MS)
    monkeypatch.undo()
    qtbot.waitUntil(procedure.run.isEnabled, timeout=LONG_MS)  # the plan may be played again
    procedure.run.click()
    qtbot.waitUntil(lambda: session.reported.activity is DeviceState.PLAYING, timeout=LONG_MS)
    qtbot.waitUntil(procedure.stop.isEnabled, timeout=LONG_MS)
    procedure.stop.click()
    qtbot.waitUntil(lambda: session.reported.activity is DeviceState.IDLE, timeout=LONG_MS)
    qtbot.waitUntil(lambda: not procedure.stop.isEnabled(), timeout=LONG_MS)
    assert panel.calibration is None


@pytest.mark.slow
def test_a_run_on_the_simulator_ends_in_a_result(qtbot, panel):
    _select_axis(panel, "zn")
    panel.workbench.session.service.set_effects(
        [AxisEffect(axis="zn", id="sensor_gain", parameters={"error": 0.02})]
    )
    panel.procedure.runs.setValue(3)
    panel.procedure.plan.click()
    qtbot.waitUntil(panel.procedure.run.isEnabled, timeout=LONG_MS)
    panel.procedure.run.click()
    qtbot.waitUntil(panel.procedure.stop.isEnabled, timeout=LONG_MS)
    status, verdict = panel.procedure.status_label, panel.result.verdict
    qtbot.waitUntil(
        lambda: panel.calibration is not None or verdict.text() or "failed" in status.text(),
        timeout=4 * LONG_MS,
    )
    assert panel.calibration is not None, (status.text(), verdict.text())
    assert panel.calibration.model.gain_error == pytest.approx(0.02, abs=1e-4)


def test_progress_and_failure_of_a_run_are_described():
    assert (
        describe_progress(CalibrationPlaybackState(CalibrationPlaybackPhase.MOVING, 0.25), 100.0)
        == "Running: 25 %, 1:15 left"
    )
    assert (
        describe_progress(CalibrationPlaybackState(CalibrationPlaybackPhase.FAILED, 0.0, "no"), 1.0)
        == "The run has failed: no."
    )
    robot = load_robot("rotemina")
    assert [has_iso_cycles(robot, axis) for axis in ("x", "zn")] == [True, False]
