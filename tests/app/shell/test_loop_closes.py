"""A corrected model is used everywhere at once, and all panels agree on the gap."""

import json
import logging
import re

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMessageBox

from rotemina.app.motion.model import NOTED_KEY
from rotemina.app.workbench import format_run_gap, format_run_gaps
from rotemina.plugins.gap.answer import DiagnosisAnswer
from rotemina.plugins.gap.answer.answer_exports import write_report
from rotemina.sim.gap.result import AxisDiagnosis, Diagnosis, GapShrinkage, GapVerdict
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

PANELS = ("plots", "comparison", "gap")
LONG_MS = 30_000
ROBOT = load_robot("rotemina")
HYSTERESIS = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 6e-6})
WRONG_HYSTERESIS = AxisEffect(axis="zn", id="hysteresis", parameters={"width": 3e-5})
CONTACT = AxisEffect(axis="zn", id="contact", parameters={"place": 6.0e-5, "stiffness": 1.0})


def make_swing(share=0.48, seconds=1.5):
    time_s = np.arange(0.0, seconds, 2e-3)
    low, high = ROBOT.axes["zn"].range
    wave = share * (high - low) * np.sin(2.0 * np.pi * time_s / seconds)
    commands = {("zn", Tap.CMD): (low + high) / 2.0 + wave}
    return Record.from_signals(time_s, commands, {"zn": "m"})


def make_answer(run, *fitted, corrected=1e-7):
    shrinkage = GapShrinkage("zn", Tap.MEAS, 2e-6, 2e-6, corrected, 1e-8, None, 0.99, None, ())
    axis = AxisDiagnosis("zn", GapVerdict.EXPLAINED, (), shrinkage=(shrinkage,), fitted=fitted)
    return DiagnosisAnswer.from_diagnosis(Diagnosis(ROBOT, {"zn": axis}), [run.name], [run.record])


def click(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def find_question(window):
    boxes = [box for box in window.findChildren(QMessageBox) if box.isVisible()]
    return boxes[0] if boxes else None


@pytest.fixture
def bench(qtbot, window):
    bench = window.workbench
    qtbot.waitUntil(lambda: bench.session.snapshot().lock_reason is None, timeout=LONG_MS)
    bench.session.service.set_effects([HYSTERESIS])
    return bench


@pytest.fixture
def play(qtbot, window, bench):
    def play(name="swing", trajectory=None):
        with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
            bench.plan_trajectory(name, make_swing() if trajectory is None else trajectory)
        assert bench.plan.dry_run.allowed
        # Effects that were just switched on move the machine; playing needs it at rest.
        qtbot.waitUntil(lambda: bench.session.at_rest, timeout=LONG_MS)
        with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
            bench.play()
        qtbot.waitUntil(lambda: bench.session.at_rest, timeout=LONG_MS)
        return bench.run

    return play


@pytest.fixture
def panel(qtbot, window):
    return window.panels["gap"]


def use_answer(qtbot, bench, panel, answer):
    panel.take_answer(answer)
    qtbot.waitUntil(panel.result.use.isEnabled, timeout=LONG_MS)
    with qtbot.waitSignals([bench.model_changed, bench.run_changed], timeout=LONG_MS):
        panel.result.use.click()


def test_a_diagnosed_model_is_used_everywhere_at_once(
    qtbot, window, bench, panel, play, tmp_path, caplog
):
    caplog.set_level(logging.INFO)
    before = play().gaps["zn", Tap.MEAS]
    assert before.rms == before.nominal > 1e-6
    nominal_tracking_rms = bench.plan.dry_run.axes["zn"].tracking_rms
    window.bring_up("gap")
    use_answer(qtbot, bench, panel, make_answer(bench.run, HYSTERESIS))
    chip = window._bar.model
    qtbot.waitUntil(lambda: chip.text().startswith("Corrected: Hysteresis"), timeout=LONG_MS)
    assert chip.property("corrected") is True
    assert f"model in use: {bench.session.model.id}" in caplog.text
    assert bench.run.gaps["zn", Tap.MEAS].rms < 0.1 * before.rms  # the same run, compared again
    assert bench.run.gaps["zn", Tap.MEAS].nominal == pytest.approx(before.rms)
    assert panel.isVisible()  # no other panel was raised over it
    qtbot.waitUntil(lambda: bench.plan.model_id == bench.session.model.id, timeout=LONG_MS)
    assert bench.plan.dry_run.axes["zn"].tracking_rms > 5.0 * nominal_tracking_rms
    run = play("again", make_swing(0.45))
    after = run.gaps["zn", Tap.MEAS]
    assert after.rms < 0.1 * after.nominal
    assert run.model_id == run.record.metadata["model"] == bench.session.model.id
    state = bench.session.snapshot()
    assert abs(state.measured["zn"] - state.model["zn"]) < 1e-7  # shown as the ghost in 3-D
    check_gap_texts(qtbot, window, run, tmp_path / "page.html")
    before_reset = run.gaps["zn", Tap.MEAS].nominal
    qtbot.waitUntil(chip.back.isEnabled, timeout=LONG_MS)
    with qtbot.waitSignals([bench.model_changed, bench.run_changed], timeout=LONG_MS):
        chip.back.trigger()
    qtbot.waitUntil(lambda: chip.text() == "Nominal model", timeout=LONG_MS)
    assert bench.run.gaps["zn", Tap.MEAS].rms == pytest.approx(before_reset)


def check_gap_texts(qtbot, window, run, page):
    """Check that plots, comparison, diagnosis and report state the same gap of a run."""
    panel = window.panels["gap"]
    gap_text = format_run_gap(run.gaps["zn", Tap.MEAS], "m")
    assert re.fullmatch(r"Gap, this run \d+(\.\d+)? (nm|µm)", gap_text)
    size = gap_text.removeprefix("Gap, this run ")
    plots = window.panels["plots"]
    window.bring_up("plots")
    plots.refresh()
    assert plots.plots["zn"].figures.text().endswith(gap_text)
    assert plots.plots["zn"].figures.text().startswith("Gap, last 10 s ")
    comparison = window.panels["comparison"].table
    window.bring_up("comparison")
    qtbot.waitUntil(lambda: comparison.rowCount() > 0)
    heads = [comparison.horizontalHeaderItem(n).text() for n in range(comparison.columnCount())]
    row = next(n for n in range(comparison.rowCount()) if "meas" in comparison.item(n, 0).text())
    assert comparison.item(row, heads.index("Gap, this run")).text() == size
    unseen_motion = panel.result.unseen_motion
    qtbot.waitUntil(lambda: unseen_motion.latest and unseen_motion.latest.name == "again")
    assert unseen_motion.title.text() == "Gap, this run"
    assert unseen_motion.table.read_texts()[0][3] == size
    write_report(panel.answer.diagnosis, panel.answer.records, page, ["a"], run)
    assert gap_text in page.read_text("utf-8")
    assert any(gap_text in line for line in format_run_gaps(run))
    figure = run.gaps["zn", Tap.MEAS]
    assert figure.without_offset < figure.rms < figure.nominal  # shown in small print next to it


def test_using_a_model_that_is_worse_on_a_motion_needs_confirmation(
    qtbot, window, bench, panel, play
):
    play()
    window.bring_up("gap")
    panel.take_answer(make_answer(bench.run, WRONG_HYSTERESIS))
    assert panel.result.use.text() == "Use corrected model"
    play("elsewhere", make_swing(0.3))
    qtbot.waitUntil(lambda: panel.result.unseen_motion.latest is not None, timeout=LONG_MS)
    assert panel.result.headline.property("tone") == "worse"
    assert panel.result.headline.sentence.text().startswith("Worse on elsewhere: Z nano ")
    assert "× larger" in panel.result.headline.sentence.text()
    assert "× larger" in panel.result.unseen_motion.table.read_texts()[0][4]
    assert "diagnose them together" in panel.result.headline.details.text() or (
        "play the motion again" in panel.result.headline.details.text()
    )
    qtbot.waitUntil(panel.result.use.isEnabled, timeout=LONG_MS)
    assert panel.result.use.text() == "Use anyway …"
    click(qtbot, panel.result.use)
    box = find_question(window)
    assert "worse than the nominal one on elsewhere: Z nano" in box.informativeText()
    assert not box.isModal()
    box.button(QMessageBox.StandardButton.No).click()
    qtbot.waitUntil(lambda: find_question(window) is None, timeout=LONG_MS)
    assert not bench.session.model.is_corrected


def test_using_a_model_learned_with_a_contact_needs_confirmation(qtbot, window, bench, panel, play):
    run = play()
    answer = make_answer(run, HYSTERESIS, CONTACT)
    noted = Record(
        run.record.time_s,
        run.record.columns,
        run.record.values,
        run.record.units,
        {**run.record.metadata, NOTED_KEY: "the tip was in contact"},
    )
    panel.take_answer(DiagnosisAnswer(answer.diagnosis, ("day one",), (noted,), answer.traces, {}))
    qtbot.waitUntil(panel.result.use.isEnabled, timeout=LONG_MS)
    panel.result.use.click()
    question_text = find_question(window).informativeText()
    assert "During day one: the tip was in contact." in question_text
    assert "The model includes contact" in question_text
    with qtbot.waitSignal(bench.model_changed, timeout=LONG_MS):
        find_question(window).button(QMessageBox.StandardButton.Yes).click()
    model = bench.session.model
    assert CONTACT not in model.without_contact.effects


def test_the_remainder_of_the_model_in_use_can_be_diagnosed(qtbot, bench, panel, play):
    play()
    robots = panel.robots
    names = [robots.itemText(n) for n in range(robots.count())]
    assert names[:2] == ["RoTeMiNa, nominal", "Remainder of the model in use"]
    use_answer(qtbot, bench, panel, make_answer(bench.run, HYSTERESIS))
    assert robots.robot == bench.robot  # a diagnosis compares with the nominal model
    robots.activated.emit(1)
    assert robots.robot.effects == (HYSTERESIS,)
    gain = AxisEffect(axis="zn", id="gain_error", parameters={"error": 1e-3})
    answer = make_answer(bench.run, gain)
    remainder = Diagnosis(robots.robot, answer.diagnosis.axes)
    use_answer(
        qtbot,
        bench,
        panel,
        DiagnosisAnswer.from_diagnosis(remainder, ["swing"], [bench.run.record]),
    )
    assert bench.session.model.effects == (HYSTERESIS, gain)
    bench.machine.use_nominal_model()
    qtbot.waitUntil(lambda: robots.robot == bench.robot, timeout=LONG_MS)
    assert json.dumps(bench.session.snapshot().model_id).startswith('"nominal-')
