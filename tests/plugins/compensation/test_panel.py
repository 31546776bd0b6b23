"""The compensation panel: learn, check, put on and take off, try, tune."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from shiboken6 import isValid

from rotemina.app.motion.state import PlaybackFinished
from rotemina.app.shell.workbench import Run
from rotemina.plugins.compensation.inverse_training import Learned, learned_from
from rotemina.plugins.compensation.trial_motion import NAME, Aid, trial_motion, trial_of
from rotemina.plugins.compensation.words import (
    exceedance_text,
    judged,
    residual_text,
)
from rotemina.sim.comparison.comparison import compare
from rotemina.sim.compensate import anfis
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.file import Provenance, write_trained
from rotemina.sim.compensate.inverse import Exceedance
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.compensate.judgement import Residual
from rotemina.sim.compensate.training import Trained
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

LONG_MS = 30_000
ROBOT = load_robot("rotemina")
SPAN = ROBOT.axes["zn"].span


def _model(kind="prandtl_ishlinskii"):
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


def _learned():
    models = {kind: _model(kind) for kind in ("prandtl_ishlinskii", "linear")}
    left_ = Residual(5e-8, 5e-8, 2e-7, 8e-4, 6e-7, 0.0, 0.0)
    residuals = {"prandtl_ishlinskii": left_, "linear": replace(left_, rms=2e-6, share=0.03)}
    trained = Trained(models, residuals, "prandtl_ishlinskii", ("Mind the gap.",))
    provenance = Provenance(robot=ROBOT.name, trained_on=[], held_out=[], seed=0, versions={})
    return Learned(trained, provenance, {})


def _record(swing=0.48, rows=3000):
    turn = np.linspace(0.0, 60.0, rows)
    shares = 0.5 - swing * np.linspace(1.0, 0.2, rows) * np.cos(turn)
    lost, play = np.empty(rows), 0.0
    for k, x in enumerate(shares):
        play = max(x - 0.1, min(x + 0.1, play))
        lost[k] = 0.8 * x + 0.15 * play
    signals = {("zn", Tap.CMD): SPAN * shares, ("zn", Tap.MEAS): SPAN * lost}
    return Record.from_signals(np.arange(rows) * 1e-3, signals, {"zn": "m"})


def _hasty(self):
    """Set an ANFIS that is trained in an instant."""
    for name, value in (("memberships", 3), ("plays", ()), ("epochs", 2), ("patience", 2)):
        object.__setattr__(self, name, value)


@pytest.fixture
def panel(make_robot_window):
    return make_robot_window("rotemina").panels["compensation"]


def test_learn_put_on_and_take_off(qtbot, panel, tmp_path, monkeypatch):
    monkeypatch.setattr(anfis.Settings, "__init__", _hasty)
    controls, session = panel.controls, panel.workbench.session
    assert [controls.axis.itemData(k) for k in range(3)] == ["thx", "thy", "zn"]
    controls.axis.setCurrentIndex(2)
    qtbot.waitUntil(lambda: "There is no inverse" in controls.switch.toolTip(), timeout=LONG_MS)
    assert not controls.record.isEnabled()

    panel.workbench.record = _record(swing=0.01)  # holds no loop: nothing is replaced
    panel.learn_record()
    qtbot.waitUntil(lambda: "nothing was replaced" in controls.doing.text(), timeout=LONG_MS)
    assert panel.learned is None

    panel.workbench.record = _record()
    panel.learn_record()
    qtbot.waitUntil(lambda: panel.learned is not None, timeout=LONG_MS)
    assert panel.check.table.rowCount() == 4
    assert "leaves" in panel.check.why.text()
    assert controls.kind.currentData() == panel.learned.trained.chosen

    path = tmp_path / "zn.json"
    learned = _learned()
    write_trained(path, learned.trained, learned.provenance)
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

    # What a play of the trial motion left is shown beside the other state's.
    motion = trial_motion(ROBOT, "zn")
    on = {"compensation zn": "PI"}, {"feedback zn": "zn.toml"}
    for metadata, state in (
        ({}, Aid.NONE),
        (on[0], Aid.INVERSE),
        (on[1], Aid.LOOP),
        (on[0] | on[1], Aid.BOTH),
    ):
        wanted = motion.signal("zn", Tap.CMD)
        signals = {("zn", Tap.CMD): wanted, ("zn", Tap.MEAS): 1.01 * wanted}
        said = {"trajectory": motion.metadata["name"], **metadata}
        played = Record.from_signals(motion.time_s, signals, {"zn": "m"}, said)
        panel._happened.emit(PlaybackFinished(played, True))
        assert state in panel.actuation.trials
    for told in controls.residuals.values():
        qtbot.waitUntil(lambda told=told: "rms, mean" in told.text(), timeout=LONG_MS)

    controls.switch.click()
    qtbot.waitUntil(lambda: session.inverses.applied == {}, timeout=LONG_MS)


def test_a_search_is_stopped_and_a_point_of_its_front_tried_kept_applied_and_taken_off(
    qtbot, panel, tmp_path
):
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
    assert panel.front.nearest(x, y) == 0
    search.keep(tmp_path / "zn.toml")
    qtbot.waitUntil(lambda: search.name == "zn.toml", timeout=LONG_MS)

    search.name = ""  # not the tuning: the point's step may still be on its way
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
    best = search.tuning.best
    bad = replace(best, gains=replace(best.gains, integral=9000.0))
    search.tuning = replace(search.tuning, points=(bad,), chosen=0, recommended=0)
    told = []
    panel.workbench.noticed.connect(lambda *notice: told.append(notice))
    panel.actuation.apply(search.tuning, "bad.toml")
    qtbot.waitUntil(lambda: any("nothing was applied" in str(one) for one in told), timeout=LONG_MS)
    assert session.loops.applied == {}
    shown = controls.typed.fields["integral"].text()
    assert float(shown) == pytest.approx(best.gains.integral, rel=1e-5)


def test_typed_gains_are_held_against_their_bounds_and_then_against_the_axis(qtbot, panel):
    controls, session, told = panel.controls, panel.workbench.session, []
    panel.workbench.noticed.connect(lambda *notice: told.append(notice))
    controls.axis.setCurrentIndex(2)
    qtbot.waitUntil(controls.apply.isEnabled, timeout=LONG_MS)
    fields = controls.typed.fields
    controls.typed.show_gains("zn", None)  # whatever a search before found
    assert float(fields["integral"].text()) > 0.0  # usual ones of the axis
    for typed, why in (
        ("1e9", "gain I = '1e9': must be a number from 0 to "),
        ("x", "gain I = 'x'"),
        (f"{2 * np.pi * 700:.1f}", "nothing was applied"),
    ):
        told.clear()
        fields["integral"].clear()
        qtbot.keyClicks(fields["integral"], typed)
        panel.actuation.apply(None, "")
        qtbot.waitUntil(lambda why=why: any(why in str(one) for one in told), timeout=LONG_MS)
    assert session.loops.applied == {}
    fields["integral"].clear()
    qtbot.keyClicks(fields["integral"], "60")
    controls.apply.click()
    qtbot.waitUntil(lambda: "zn" in session.loops.applied, timeout=LONG_MS)
    assert ", I 60, " in session.loops.applied["zn"].name
    assert session.loops.applied["zn"].regulation.gains.integral == 60.0
    session.loops.remove("zn")
    qtbot.waitUntil(lambda: session.loops.applied == {}, timeout=LONG_MS)


def test_a_trial_waits_until_nobody_drives_the_axis(qtbot, panel):
    controls, session = panel.controls, panel.workbench.session
    controls.axis.setCurrentIndex(2)
    qtbot.waitUntil(controls.trial.isEnabled, timeout=LONG_MS)
    session.reservations.reserve("somebody")
    said = "somebody still controls axis"
    for button in (controls.trial, controls.sweep, controls.apply):
        qtbot.waitUntil(lambda button=button: said in button.toolTip(), timeout=LONG_MS)
        assert not button.isEnabled()
    session.reservations.set_free("somebody")
    qtbot.waitUntil(controls.trial.isEnabled, timeout=LONG_MS)
    assert "no inverse is active" in controls.sweep.toolTip()


@pytest.mark.slow
def test_before_and_after_on_the_simulated_machine(qtbot, panel):
    controls, session = panel.controls, panel.workbench.session
    width = {"width": 0.12 * SPAN}
    session.service.set_effects([AxisEffect(axis="zn", id="hysteresis", parameters=width)])
    qtbot.waitUntil(lambda: bool(session.service.effects), timeout=LONG_MS)
    controls.axis.setCurrentIndex(2)
    panel.learn_simulated()
    qtbot.waitUntil(lambda: panel.learned is not None, timeout=4 * LONG_MS)
    for by in (Aid.NONE, Aid.INVERSE):
        if by is Aid.INVERSE:
            qtbot.waitUntil(controls.switch.isEnabled, timeout=LONG_MS)
            controls.switch.click()
            qtbot.waitUntil(lambda: "zn" in session.inverses.applied, timeout=LONG_MS)
        # The axis goes to where the inverse puts it; the button knows that a refresh later.
        qtbot.waitUntil(lambda: not session.snapshot().owners, timeout=LONG_MS)
        qtbot.waitUntil(controls.trial.isEnabled, timeout=LONG_MS)
        controls.trial.click()
        qtbot.waitUntil(lambda by=by: by in panel.actuation.trials, timeout=LONG_MS)
    trials = panel.actuation.trials
    assert trials[Aid.INVERSE].rms < 0.15 * trials[Aid.NONE].rms
    mean = trials[Aid.INVERSE].offset
    qtbot.waitUntil(controls.sweep.isEnabled, timeout=LONG_MS)
    controls.sweep.click()
    qtbot.waitUntil(lambda: not controls.trial.isEnabled(), timeout=LONG_MS)
    qtbot.waitUntil(controls.trial.isEnabled, timeout=LONG_MS)
    panel.actuation.forget()
    controls.trial.click()
    qtbot.waitUntil(lambda: Aid.INVERSE in trials, timeout=LONG_MS)
    assert abs(trials[Aid.INVERSE].offset) < max(abs(mean), 0.2e-6)


def test_a_window_that_closes_right_after_a_trial_leaves_nothing_behind(qtbot, panel):
    """Coming to the front waits for a turn of the event loop; the panel may be gone by then."""
    motion = trial_motion(ROBOT, "zn")
    path = motion.signal("zn", Tap.CMD)
    signals = {("zn", Tap.CMD): path, ("zn", Tap.MEAS): path}
    trial = Record.from_signals(motion.time_s, signals, {"zn": "m"}, {"trajectory": NAME})
    window, bench = panel.window(), panel.workbench
    with qtbot.captureExceptions() as raised:
        bench.run_changed.emit(Run("trial", compare(bench.robot, trial)))
        bench.close()
        window.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        QCoreApplication.processEvents()
    assert not isValid(panel)
    assert raised == []


def test_a_trial_is_told_from_other_plays():
    motion = trial_motion(ROBOT, "zn")
    path = motion.signal("zn", Tap.CMD)
    low, high = ROBOT.axes["zn"].range
    assert low < path.min() < path.max() < high
    assert path[0] == pytest.approx(0.5 * (low + high))
    signals = {("zn", Tap.CMD): path, ("zn", Tap.MEAS): path + 2e-7}
    said = {"trajectory": "compensation trial"}
    trial = trial_of(Record.from_signals(motion.time_s, signals, {"zn": "m"}, said), "zn")
    assert trial is not None
    assert trial.by is Aid.NONE
    assert (trial.rms, trial.offset) == pytest.approx((0.0, 2e-7), abs=1e-12)
    assert trial_of(Record.from_signals(motion.time_s, signals, {"zn": "m"}), "zn") is None
    assert trial_of(Record.from_signals(motion.time_s, signals, {"zn": "m"}, said), "thx") is None


def test_a_stopped_training_raises_where_it_tells():
    class EnoughError(Exception):
        pass

    def tell(_what, share):
        if share > 0.0:
            raise EnoughError

    with pytest.raises(EnoughError):
        learned_from(ROBOT, "zn", [("a", _record())], tell)
    with pytest.raises(CompensationError, match="a: axis thx needs the columns"):
        learned_from(ROBOT, "thx", [("a", _record())], lambda *_: None)


def test_words():
    learned = _learned()
    rows = judged(learned.trained)
    assert rows[0] == ("Prandtl–Ishlinskii ◂", "50 nm", "200 nm", "0.08 %")
    assert rows[1][0] == "linear"
    assert residual_text(None, "m") == "–"
    assert exceedance_text(Exceedance(0)) == ""
    assert exceedance_text(Exceedance.FAST | Exceedance.COMMAND) == (
        "The axis has been faster than in training, at an end of the machine's range (clamped)."
    )
