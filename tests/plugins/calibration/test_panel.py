"""The panel of sensor calibration: plan, result, store, on and off."""

import numpy as np
import pytest

from rotemina.app.calibration.calibration_playback import Phase, RunState
from rotemina.app.plugin_kit.panel_bench import panel_bench
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.calibration.panel import CalibrationPanel
from rotemina.plugins.calibration.words import cycles, progress
from rotemina.sim.calibration.plan import calibration_motion
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

LONG_MS = 30_000


@pytest.fixture
def panel(make_robot_window):
    return make_robot_window("rotemina").panels["calibration"]


def _choose(panel, axis):
    panel.procedure.axis.setCurrentIndex(panel.procedure.axis.findData(axis))


def _record(robot, error):
    motion = calibration_motion(robot, "zn", runs=3, rate_hz=500.0)
    effect = AxisEffect(axis="zn", id="sensor_gain", parameters={"error": error})
    return simulate(robot, [effect], motion, np.random.default_rng(1))


def _fit(qtbot, panel, record):
    panel.calibration = None
    panel.fit_record("zn.csv", record)
    qtbot.waitUntil(lambda: panel.calibration is not None, timeout=LONG_MS)


def test_from_a_plan_to_a_calibration_that_is_on(qtbot, panel):
    workbench, procedure = panel.workbench, panel.procedure
    corrections = workbench.session.corrections
    _choose(panel, "zn")
    assert not procedure.targets.isEnabled()  # a piezo makes no cycles of ISO 230-2
    qtbot.waitUntil(lambda: "there is no plan" in procedure.run.toolTip(), timeout=LONG_MS)
    procedure.plan.click()
    qtbot.waitUntil(lambda: procedure.run.isEnabled(), timeout=LONG_MS)
    assert "5 runs, triangles and moves" in procedure.told.text()
    procedure.runs.setValue(4)  # the plan is of no use any more
    qtbot.waitUntil(lambda: not procedure.run.isEnabled(), timeout=LONG_MS)

    _fit(qtbot, panel, _record(workbench.robot, 0.0))
    assert panel.result.verdict.text().startswith("Refused: zn")
    assert not panel.result.store.isEnabled()

    _fit(qtbot, panel, _record(workbench.robot, 0.02))
    assert panel.result.figures.item(1, 0).text() == "gain error"
    assert panel.result.figures.item(1, 1).text().startswith(("2 %", "1.99", "2.00"))
    panel.result.store.click()
    qtbot.waitUntil(lambda: panel.stored.stored != (), timeout=LONG_MS)
    (kept,) = panel.stored.stored
    assert kept.on
    assert corrections.names == {"zn": kept.calibration.name}
    assert not panel.result.store.isEnabled()

    panel.stored.table.selectRow(0)
    panel.stored.off.click()
    qtbot.waitUntil(lambda: corrections.names == {}, timeout=LONG_MS)
    qtbot.waitUntil(lambda: panel.stored.on.isEnabled(), timeout=LONG_MS)


def test_nothing_can_be_run_or_stopped_before_the_first_frame():
    with panel_bench(CalibrationPanel) as bench:
        procedure = bench.panel.procedure
        assert not procedure.run.isEnabled()
        assert not procedure.stop.isEnabled()


def test_a_run_asked_for_while_the_machine_moves_waits_and_can_be_stopped(
    qtbot, panel, monkeypatch
):
    session, procedure = panel.workbench.session, panel.procedure
    _choose(panel, "zn")
    procedure.plan.click()
    qtbot.waitUntil(procedure.run.isEnabled, timeout=LONG_MS)
    plan = procedure.told.text()
    monkeypatch.setattr(type(session), "at_rest", False)
    procedure.run.click()
    qtbot.waitUntil(procedure.stop.isEnabled, timeout=LONG_MS)
    procedure.stop.click()
    qtbot.waitUntil(lambda: procedure.told.text() == plan, timeout=LONG_MS)
    monkeypatch.undo()
    qtbot.waitUntil(procedure.run.isEnabled, timeout=LONG_MS)  # the plan may be played again
    procedure.run.click()
    qtbot.waitUntil(lambda: session.reported.activity is DeviceState.PLAYING, timeout=LONG_MS)


@pytest.mark.slow
def test_a_run_on_the_simulator_ends_in_a_result(qtbot, panel):
    _choose(panel, "zn")
    panel.workbench.session.service.set_effects(
        [AxisEffect(axis="zn", id="sensor_gain", parameters={"error": 0.02})]
    )
    panel.procedure.runs.setValue(3)
    panel.procedure.plan.click()
    qtbot.waitUntil(panel.procedure.run.isEnabled, timeout=LONG_MS)
    panel.procedure.run.click()
    qtbot.waitUntil(panel.procedure.stop.isEnabled, timeout=LONG_MS)
    told, verdict = panel.procedure.told, panel.result.verdict
    qtbot.waitUntil(
        lambda: panel.calibration is not None or verdict.text() or "failed" in told.text(),
        timeout=4 * LONG_MS,
    )
    assert panel.calibration is not None, (told.text(), verdict.text())
    assert panel.calibration.model.gain_error == pytest.approx(0.02, abs=1e-4)


@pytest.mark.slow
def test_stop_gives_a_run_up(qtbot, panel):
    _choose(panel, "zn")
    panel.procedure.plan.click()
    qtbot.waitUntil(panel.procedure.run.isEnabled, timeout=LONG_MS)
    panel.procedure.run.click()
    qtbot.waitUntil(panel.procedure.stop.isEnabled, timeout=LONG_MS)
    panel.procedure.stop.click()
    qtbot.waitUntil(lambda: not panel.procedure.stop.isEnabled(), timeout=LONG_MS)
    assert panel.calibration is None


def test_words_of_a_run():
    assert progress(RunState(Phase.MOVING, 0.25), 100.0) == "Running: 25 %, 1:15 left"
    assert progress(RunState(Phase.FAILED, 0.0, "no"), 1.0) == "The run has failed: no."
    robot = load_robot("rotemina")
    assert [cycles(robot, axis) for axis in ("x", "zn")] == [True, False]
