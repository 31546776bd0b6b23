"""The compensation panel: train, check, apply and remove an inverse, run a trial, tune a loop."""

from dataclasses import replace
from threading import Event

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from shiboken6 import isValid

from rotemina.app.motion.state import PlaybackFinished
from rotemina.app.workbench import ComparedRun
from rotemina.plugins.compensation import gain_search
from rotemina.plugins.compensation.inverse_training import TrainedInverses, train_from_records
from rotemina.plugins.compensation.trial_motion import (
    TRIAL_NAME,
    CompensationMode,
    evaluate_trial,
    make_trial_motion,
)
from rotemina.plugins.compensation.words import (
    exceedance_text,
    make_residual_rows,
    residual_text,
)
from rotemina.sim.comparison import compare
from rotemina.sim.compensate import (
    InverseExceedance,
    InverseModel,
    InverseProvenance,
    InverseResidual,
    TrainingResult,
    anfis,
    write_trained,
)
from rotemina.sim.errors import CompensationError, TuningError
from rotemina.sim.feedback import ControllerGains
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot
from rotemina.sim.tuning import FrontPoint, SearchGeneration, SecondObjective, TuningResult
from rotemina.sim.tuning.performance_figures import TuningFigures
from rotemina.sim.tuning.tuning_result import TuningProvenance

LONG_MS = 30_000
ROBOT = load_robot("rotemina")
SPAN = ROBOT.axes["zn"].span


def _make_inverse_model(kind="prandtl_ishlinskii"):
    return InverseModel(
        axis="zn",
        unit="m",
        kind=kind,
        sample_s=1e-3,
        origin=0.0,
        command_origin=0.0,
        span=SPAN,
        desired_range=(1e-6, 60e-6),
        command_range=(0.0, SPAN),
        speed=1.0,
        consequents=np.array([[0.0, 0.9, 0.1]]),
        radii=np.array([0.1]),
        initial=np.zeros(1),
    )


def _make_trained_inverses():
    models = {kind: _make_inverse_model(kind) for kind in ("prandtl_ishlinskii", "linear")}
    residual = InverseResidual(5e-8, 5e-8, 2e-7, 8e-4, 6e-7, 0.0, 0.0)
    residuals = {"prandtl_ishlinskii": residual, "linear": replace(residual, rms=2e-6, share=0.03)}
    trained = TrainingResult(models, residuals, "prandtl_ishlinskii", ("Mind the gap.",))
    provenance = InverseProvenance(
        robot=ROBOT.name, trained_on=[], held_out=[], seed=0, versions={}
    )
    return TrainedInverses(trained, provenance, {})


def _make_hysteresis_record(swing=0.48, rows=3000):
    phase = np.linspace(0.0, 60.0, rows)
    shares = 0.5 - swing * np.linspace(1.0, 0.2, rows) * np.cos(phase)
    measured, play = np.empty(rows), 0.0
    for k, share in enumerate(shares):
        play = max(share - 0.1, min(share + 0.1, play))
        measured[k] = 0.8 * share + 0.15 * play
    signals = {("zn", Tap.CMD): SPAN * shares, ("zn", Tap.MEAS): SPAN * measured}
    return Record.from_signals(np.arange(rows) * 1e-3, signals, {"zn": "m"})


def _init_fast_settings(self):
    """Initialize settings with which an ANFIS trains almost instantly."""
    for name, value in (("memberships", 3), ("plays", ()), ("epochs", 2), ("patience", 2)):
        object.__setattr__(self, name, value)


@pytest.fixture
def panel(make_robot_window):
    return make_robot_window("rotemina").panels["compensation"]


def test_an_inverse_is_trained_checked_applied_and_removed(qtbot, panel, tmp_path, monkeypatch):
    monkeypatch.setattr(anfis.AnfisSettings, "__init__", _init_fast_settings)
    controls, session = panel.controls, panel.workbench.session
    assert [controls.axis.itemData(k) for k in range(3)] == ["thx", "thy", "zn"]
    controls.axis.setCurrentIndex(2)
    qtbot.waitUntil(lambda: "There is no inverse" in controls.switch.toolTip(), timeout=LONG_MS)
    assert not controls.record.isEnabled()

    # The swing is too small for a hysteresis loop.
    panel.workbench.record = _make_hysteresis_record(swing=0.01)
    panel.train_from_record()
    qtbot.waitUntil(lambda: "nothing was replaced" in controls.doing.text(), timeout=LONG_MS)
    assert panel.inverses is None

    panel.workbench.record = _make_hysteresis_record()
    panel.train_from_record()
    qtbot.waitUntil(lambda: panel.inverses is not None, timeout=LONG_MS)
    assert panel.check.table.rowCount() == 4
    assert "leaves" in panel.check.why.text()
    assert controls.kind.currentData() == panel.inverses.trained.recommended_kind

    path = tmp_path / "zn.json"
    inverses = _make_trained_inverses()
    write_trained(path, inverses.trained, inverses.provenance)
    panel.open_file(path)
    qtbot.waitUntil(lambda: "Mind the gap" in panel.check.why.text(), timeout=LONG_MS)
    controls.axis.setCurrentIndex(0)
    qtbot.waitUntil(lambda: "belongs to axis zn" in controls.switch.toolTip(), timeout=LONG_MS)
    controls.axis.setCurrentIndex(2)
    qtbot.waitUntil(controls.switch.isEnabled, timeout=LONG_MS)
    controls.switch.click()
    qtbot.waitUntil(lambda: "zn" in session.inverses.applied, timeout=LONG_MS)
    assert session.inverses.applied["zn"].name == "Prandtl–Ishlinskii, zn.json"
    qtbot.waitUntil(lambda: controls.switch.text() == "Remove", timeout=LONG_MS)
    qtbot.waitUntil(controls.switch.isEnabled, timeout=LONG_MS)

    # The residual of each trial run is shown next to those of the other states.
    motion = make_trial_motion(ROBOT, "zn")
    applied_metadata = {"compensation zn": "PI"}, {"feedback zn": "zn.toml"}
    for metadata, state in (
        ({}, CompensationMode.NONE),
        (applied_metadata[0], CompensationMode.INVERSE),
        (applied_metadata[1], CompensationMode.LOOP),
        (applied_metadata[0] | applied_metadata[1], CompensationMode.BOTH),
    ):
        command = motion.signal("zn", Tap.CMD)
        signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): 1.01 * command}
        record_metadata = {"trajectory": motion.metadata["name"], **metadata}
        record = Record.from_signals(motion.time_s, signals, {"zn": "m"}, record_metadata)
        panel._event_received.emit(PlaybackFinished(record, True))
        assert state in panel.actions_on_machine.trials
    for residual_label in controls.residuals.values():
        qtbot.waitUntil(
            lambda residual_label=residual_label: "rms, mean" in residual_label.text(),
            timeout=LONG_MS,
        )

    controls.switch.click()
    qtbot.waitUntil(lambda: session.inverses.applied == {}, timeout=LONG_MS)


def test_a_point_of_a_stopped_search_is_saved_opened_applied_and_removed(qtbot, panel, tmp_path):
    controls, session, search = panel.controls, panel.workbench.session, panel.search
    controls.axis.setCurrentIndex(2)
    qtbot.waitUntil(lambda: "there is no front" in controls.keep.toolTip(), timeout=LONG_MS)
    controls.generations.setValue(60)
    panel.tune()
    qtbot.waitUntil(lambda: "generations" in controls.doing.text(), timeout=LONG_MS)
    controls.stop.setEnabled(True)
    controls.stop.click()
    qtbot.waitUntil(lambda: search.tuning is not None, timeout=LONG_MS)
    assert search.tuning.provenance.done < 60
    search.pick(0)
    assert search.tuning.chosen == 0
    assert controls.point.text().startswith("Point 0: tracking ")
    curve = panel.front.step.plot._curves["position"]
    qtbot.waitUntil(lambda: curve.getData()[0] is not None, timeout=LONG_MS)
    x, y = panel.front._front[0] * (100.0, 1.0)
    assert panel.front.find_nearest(x, y) == 0
    search.save(tmp_path / "zn.toml")
    qtbot.waitUntil(lambda: search.name == "zn.toml", timeout=LONG_MS)

    search.name = ""  # only the name: the step response of the point may still be pending
    search.open(tmp_path / "zn.toml")
    qtbot.waitUntil(lambda: search.name == "zn.toml", timeout=LONG_MS)
    assert search.tuning.chosen == 0
    qtbot.waitUntil(controls.apply.isEnabled, timeout=LONG_MS)
    controls.apply.click()
    qtbot.waitUntil(lambda: "zn" in session.loops.applied, timeout=LONG_MS)
    assert session.loops.applied["zn"].name == "zn.toml, point 0"
    qtbot.waitUntil(lambda: controls.apply.text() == "Open loop", timeout=LONG_MS)
    qtbot.waitUntil(controls.apply.isEnabled, timeout=LONG_MS)
    controls.apply.click()
    qtbot.waitUntil(lambda: session.loops.applied == {}, timeout=LONG_MS)

    # Gains that are not stable on the axis are never applied.
    best = search.tuning.chosen_point
    unstable_point = replace(best, gains=replace(best.gains, integral=9000.0))
    search.tuning = replace(search.tuning, points=(unstable_point,), chosen=0, recommended=0)
    notices = []
    panel.workbench.notice_posted.connect(lambda *notice: notices.append(notice))
    panel.actions_on_machine.apply(search.tuning, "bad.toml")
    qtbot.waitUntil(
        lambda: any("nothing was applied" in str(received_notice) for received_notice in notices),
        timeout=LONG_MS,
    )
    assert session.loops.applied == {}
    integral_text = controls.typed.fields["integral"].text()
    assert float(integral_text) == pytest.approx(best.gains.integral, rel=1e-5)


def _make_tuning(points=2):
    provenance = TuningProvenance(
        program="",
        robot=ROBOT.name,
        effects=(),
        inverse="",
        generations=1,
        done=1,
        population=4,
        seed=1,
        against=SecondObjective.EFFORT,
        peak_sensitivity=1.7,
        overshoot=0.02,
        spread=0.05,
    )
    figures = TuningFigures(
        tracking_rms=0.01,
        settling_s=0.01,
        overshoot=0.0,
        absolute_error=1e-9,
        effort=2.0,
        peak_sensitivity=1.5,
        limited=0.0,
    )
    return TuningResult(
        axis="zn",
        rate_hz=5000.0,
        delay=0,
        recommended=0,
        chosen=1,
        provenance=provenance,
        points=tuple(
            FrontPoint(
                gains=ControllerGains(integral=60.0 + index),
                figures=replace(figures, tracking_rms=0.01 * (index + 1)),
            )
            for index in range(points)
        ),
    )


@pytest.mark.parametrize("tuning", [None, _make_tuning()])
def test_a_failed_search_keeps_the_previous_front(qtbot, panel, monkeypatch, tuning):
    search, front = panel.search, panel.front
    if tuning is not None:
        search._use_tuning(tuning, None, "zn.toml")
    may_fail = Event()

    def fail_after_one_generation(_problem, _settings, report, _inverse):
        report(SearchGeneration(1, 2, _make_tuning(points=3).points))
        may_fail.wait(LONG_MS / 1000.0)
        raise TuningError("no gains meet the constraints")

    monkeypatch.setattr(gain_search, "make_problem", lambda *_: None)
    monkeypatch.setattr(gain_search, "search_gains", fail_after_one_generation)
    with qtbot.waitSignal(search.failed, timeout=LONG_MS):
        panel.tune()
        qtbot.waitUntil(lambda: len(front._front) == 3, timeout=LONG_MS)
        front.picked.emit(2)  # a point of the running search is no result yet
        may_fail.set()
    assert "nothing was replaced" in panel.controls.doing.text()
    assert search.tuning == tuning
    if tuning is not None:
        assert search.name == "zn.toml"
        assert len(front._front) == 2
        front.picked.emit(0)
        assert search.tuning.chosen == 0
    else:
        assert len(front._front) == 0


def test_typed_gains_are_checked_against_their_bounds_and_then_on_the_axis(qtbot, panel):
    controls, session, notices = panel.controls, panel.workbench.session, []
    panel.workbench.notice_posted.connect(lambda *notice: notices.append(notice))
    controls.axis.setCurrentIndex(2)
    qtbot.waitUntil(controls.apply.isEnabled, timeout=LONG_MS)
    fields = controls.typed.fields
    controls.typed.show_gains("zn", None)  # independent of earlier search results
    assert float(fields["integral"].text()) > 0.0  # the default gains of the axis
    for text, reason in (
        ("1e9", "gain I = '1e9': must be a number from 0 to "),
        ("x", "gain I = 'x'"),
        (f"{2 * np.pi * 700:.1f}", "nothing was applied"),
    ):
        notices.clear()
        fields["integral"].clear()
        qtbot.keyClicks(fields["integral"], text)
        panel.actions_on_machine.apply(None, "")
        qtbot.waitUntil(
            lambda reason=reason: any(
                reason in str(received_notice) for received_notice in notices
            ),
            timeout=LONG_MS,
        )
    assert session.loops.applied == {}
    fields["integral"].clear()
    qtbot.keyClicks(fields["integral"], "60")
    controls.apply.click()
    qtbot.waitUntil(lambda: "zn" in session.loops.applied, timeout=LONG_MS)
    assert ", I 60, " in session.loops.applied["zn"].name
    assert session.loops.applied["zn"].regulation.gains.integral == 60.0
    session.loops.remove("zn")
    qtbot.waitUntil(lambda: session.loops.applied == {}, timeout=LONG_MS)


def test_a_trial_is_disabled_while_the_axis_is_reserved(qtbot, panel):
    controls, session = panel.controls, panel.workbench.session
    controls.axis.setCurrentIndex(2)
    qtbot.waitUntil(controls.trial.isEnabled, timeout=LONG_MS)
    session.reservations.reserve("somebody")
    reason = "somebody still controls axis"
    for button in (controls.trial, controls.sweep, controls.apply):
        qtbot.waitUntil(lambda button=button: reason in button.toolTip(), timeout=LONG_MS)
        assert not button.isEnabled()
    session.reservations.end_reservations("somebody")
    qtbot.waitUntil(controls.trial.isEnabled, timeout=LONG_MS)
    assert "no inverse is active" in controls.sweep.toolTip()


@pytest.mark.slow
def test_an_inverse_reduces_the_trial_error_on_the_simulator(qtbot, panel):
    controls, session = panel.controls, panel.workbench.session
    width = {"width": 0.12 * SPAN}
    session.service.set_effects([AxisEffect(axis="zn", id="hysteresis", parameters=width)])
    qtbot.waitUntil(lambda: bool(session.service.effects), timeout=LONG_MS)
    controls.axis.setCurrentIndex(2)
    panel.train_in_simulation()
    qtbot.waitUntil(lambda: panel.inverses is not None, timeout=4 * LONG_MS)
    for mode in (CompensationMode.NONE, CompensationMode.INVERSE):
        if mode is CompensationMode.INVERSE:
            qtbot.waitUntil(controls.switch.isEnabled, timeout=LONG_MS)
            controls.switch.click()
            qtbot.waitUntil(lambda: "zn" in session.inverses.applied, timeout=LONG_MS)
        # The inverse moves the axis first; the button follows one refresh later.
        qtbot.waitUntil(lambda: not session.snapshot().owners, timeout=LONG_MS)
        qtbot.waitUntil(controls.trial.isEnabled, timeout=LONG_MS)
        controls.trial.click()
        qtbot.waitUntil(lambda mode=mode: mode in panel.actions_on_machine.trials, timeout=LONG_MS)
    trials = panel.actions_on_machine.trials
    assert trials[CompensationMode.INVERSE].rms < 0.15 * trials[CompensationMode.NONE].rms
    offset = trials[CompensationMode.INVERSE].offset
    qtbot.waitUntil(controls.sweep.isEnabled, timeout=LONG_MS)
    controls.sweep.click()
    qtbot.waitUntil(lambda: not controls.trial.isEnabled(), timeout=LONG_MS)
    qtbot.waitUntil(controls.trial.isEnabled, timeout=LONG_MS)
    panel.actions_on_machine.forget_trials()
    controls.trial.click()
    qtbot.waitUntil(lambda: CompensationMode.INVERSE in trials, timeout=LONG_MS)
    assert abs(trials[CompensationMode.INVERSE].offset) < max(abs(offset), 0.2e-6)


def test_a_window_that_closes_right_after_a_trial_raises_nothing(qtbot, panel):
    """The panel is raised in the next turn of the event loop, when it may already be deleted."""
    motion = make_trial_motion(ROBOT, "zn")
    positions = motion.signal("zn", Tap.CMD)
    signals = {("zn", Tap.CMD): positions, ("zn", Tap.MEAS): positions}
    trial = Record.from_signals(motion.time_s, signals, {"zn": "m"}, {"trajectory": TRIAL_NAME})
    window, workbench = panel.window(), panel.workbench
    with qtbot.captureExceptions() as exceptions:
        workbench.run_changed.emit(ComparedRun("trial", compare(workbench.robot, trial)))
        workbench.close()
        window.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        QCoreApplication.processEvents()
    assert not isValid(panel)
    assert exceptions == []


def test_a_trial_is_distinguished_from_other_playbacks():
    motion = make_trial_motion(ROBOT, "zn")
    positions = motion.signal("zn", Tap.CMD)
    low, high = ROBOT.axes["zn"].range
    assert low < positions.min() < positions.max() < high
    assert positions[0] == pytest.approx(0.5 * (low + high))
    signals = {("zn", Tap.CMD): positions, ("zn", Tap.MEAS): positions + 2e-7}
    metadata = {"trajectory": "compensation trial"}
    trial = evaluate_trial(Record.from_signals(motion.time_s, signals, {"zn": "m"}, metadata), "zn")
    assert trial is not None
    assert trial.mode is CompensationMode.NONE
    assert (trial.rms, trial.offset) == pytest.approx((0.0, 2e-7), abs=1e-12)
    assert evaluate_trial(Record.from_signals(motion.time_s, signals, {"zn": "m"}), "zn") is None
    assert (
        evaluate_trial(Record.from_signals(motion.time_s, signals, {"zn": "m"}, metadata), "thx")
        is None
    )


def test_an_exception_of_the_progress_callback_stops_the_training():
    class StopTrainingError(Exception):
        pass

    def report_progress(_text, share):
        if share > 0.0:
            raise StopTrainingError

    with pytest.raises(StopTrainingError):
        train_from_records(ROBOT, "zn", [("a", _make_hysteresis_record())], report_progress)
    with pytest.raises(CompensationError, match="a: axis thx needs the columns"):
        train_from_records(ROBOT, "thx", [("a", _make_hysteresis_record())], lambda *_: None)


def test_residuals_and_exceedances_are_described():
    inverses = _make_trained_inverses()
    rows = make_residual_rows(inverses.trained)
    assert rows[0] == ("Prandtl–Ishlinskii ◂", "50 nm", "200 nm", "0.08 %")
    assert rows[1][0] == "linear"
    assert residual_text(None, "m") == "–"
    assert exceedance_text(InverseExceedance(0)) == ""
    assert exceedance_text(InverseExceedance.FAST | InverseExceedance.COMMAND) == (
        "The axis has been faster than in training, at an end of the machine's range (clamped)."
    )
