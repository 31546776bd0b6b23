"""The gap page: choosing records, running a diagnosis without blocking, views and exports."""

import json
import threading
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog, QMessageBox

from rotemina.app.shell.help import FirstStepsCard
from rotemina.app.shell.records.column_mapping import ColumnMappingDialog
from rotemina.app.workbench import ComparedRun
from rotemina.plugins.gap.answer import DiagnosisAnswer, answer_exports
from rotemina.plugins.gap.answer.distribution_view import compute_warmth
from rotemina.plugins.gap.answer.ranking_view import name_causes
from rotemina.plugins.gap.diagnosing.diagnosis_job import DiagnosisStoppedError, describe_progress
from rotemina.plugins.gap.diagnosing.diagnosis_process import DiagnosisProcess
from rotemina.sim.comparison import compare
from rotemina.sim.errors import GapError
from rotemina.sim.gap.output import as_json
from rotemina.sim.gap.result import Grade, Progress, SuggestedExperiment
from rotemina.sim.gap.result.ranking import Standings
from rotemina.sim.messages import message
from rotemina.sim.records import Record, Tap, write_record
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import format_robot, load_robot

ROBOT = load_robot("rotemina")
LONG_MS = 30_000
WHERE_TAB, WHICH_TAB, HOW_FAR_TAB, PROOF_TAB = range(4)


class StepwiseDiagnosis:
    """A fake diagnosis that waits for permission at each step, and notes its thread and its end."""

    def __init__(self, diagnosis):
        self.diagnosis = diagnosis
        self.steps = threading.Semaphore(0)
        self.calls, self.threads, self.ends, self.rankings = [], [], [], []

    def __call__(self, robot, records, listener):
        self.calls.append((robot, records))
        self.threads.append(threading.current_thread())
        try:
            for share in (0.1, 0.5):
                ranking = self.rankings.pop(0) if self.rankings else None
                listener(Progress("fitting", "thx", "hysteresis", share, ranking))
                assert self.steps.acquire(timeout=20.0)
            listener(Progress("deciding", None, None, 0.9))
        except DiagnosisStoppedError:
            self.ends.append("stopped")
            raise
        self.ends.append("answered")
        return self.diagnosis


def replace_diagnosis(monkeypatch, diagnose):
    """Replace the diagnosis process by a function that runs in the waiting thread."""

    def answer(_self, robot, names, records, listener):
        return DiagnosisAnswer.from_diagnosis(diagnose(robot, records, listener), names, records)

    monkeypatch.setattr(DiagnosisProcess, "diagnose", answer)


@pytest.fixture
def stepwise_diagnosis(monkeypatch, diagnosis):
    diagnosis_function = StepwiseDiagnosis(diagnosis)
    replace_diagnosis(monkeypatch, diagnosis_function)
    yield diagnosis_function
    diagnosis_function.steps.release(100)


def click(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def find_question(window):
    boxes = [box for box in window.findChildren(QMessageBox) if box.isVisible()]
    return boxes[0] if boxes else None


def get_newest_notice(window):
    return window.notices[-1] if window.notices else ""


def wait_until_saved(qtbot, window, path):
    qtbot.waitUntil(lambda: f"Saved {path}" in window.notices, timeout=LONG_MS)


def test_without_records_the_page_shows_the_first_step(panel):
    assert panel.result.views.currentWidget() is panel.result.hint
    assert panel.result.hint.text().startswith("1  Choose records")
    assert panel.start.text() == "Diagnose …"  # opens a dialog to choose records
    for button in (panel.stop, panel.result.twin, panel.result.motion, panel.result.report):
        assert not button.isEnabled()
        assert "Not now: " in button.toolTip()
    assert panel.result.tabs.isHidden()
    panel.diagnose()  # called from the palette or a script
    assert not panel.diagnosing.running


def test_diagnose_without_records_asks_for_files_and_then_starts(
    qtbot, window, panel, stepwise_diagnosis, record, tmp_path
):
    write_record(record, tmp_path / "one.csv")
    write_record(record, tmp_path / "two.csv")
    click(qtbot, panel.start)
    dialog = next(
        candidate for candidate in window.findChildren(QFileDialog) if candidate.isVisible()
    )
    dialog.close()
    panel.records.add_files([tmp_path / "one.csv", tmp_path / "two.csv"])
    qtbot.waitUntil(lambda: len(stepwise_diagnosis.calls) == 1, timeout=LONG_MS)
    assert len(stepwise_diagnosis.calls[0][1]) == 2  # it waits until both files are read
    assert panel.result.views.currentWidget() is panel.result.running
    panel.stop_diagnosis()


def test_the_first_steps_card_starts_one_diagnosis(qtbot, panel, stepwise_diagnosis, record):
    workbench = panel.workbench
    workbench.run_changed.emit(ComparedRun("played", compare(workbench.robot, record)))
    card = FirstStepsCard(workbench)
    qtbot.addWidget(card)
    for _ in range(2):  # the second click finds a running diagnosis
        card.diagnose.click()
        assert panel.diagnosing.running
    qtbot.waitUntil(lambda: bool(stepwise_diagnosis.calls), timeout=LONG_MS)
    panel.stop_diagnosis()
    assert len(stepwise_diagnosis.calls) == 1


def test_the_last_playback_is_used_until_a_record_is_chosen(panel, record):
    workbench = panel.workbench
    first, second = (
        ComparedRun(name, compare(workbench.robot, record)) for name in ("first", "second")
    )
    workbench.run_changed.emit(first)
    workbench.run_changed.emit(second)
    assert [run.name for run in panel.records.chosen] == ["second"]
    assert panel.start.isEnabled()
    panel.records.tick_run(first)
    workbench.run_changed.emit(second)
    assert [run.name for run in panel.records.chosen] == ["first"]


def test_files_are_added_and_ticked_with_the_menu_and_unreadable_ones_become_notices(
    qtbot, window, panel, record, tmp_path
):
    (tmp_path / "bare.csv").write_text("0,1\n1,2\n2,3\n")
    paths = [tmp_path / name for name in ("a & b.csv", "<b>two.csv")]
    for path in paths:
        write_record(record, path)
    panel.records.add_files([tmp_path / "bare.csv", *paths])
    qtbot.waitUntil(lambda: len(panel.records.chosen) == 2, timeout=LONG_MS)
    qtbot.waitUntil(lambda: all(choice.entry for choice in panel.records.chosen), timeout=LONG_MS)
    qtbot.waitUntil(lambda: "no header" in get_newest_notice(window), timeout=LONG_MS)
    panel.records.add_files([tmp_path / "missing.csv"])
    qtbot.waitUntil(lambda: "missing.csv" in get_newest_notice(window), timeout=LONG_MS)
    menu_button = panel.rail.menu
    assert menu_button.text() == "2 records"
    assert "&lt;b&gt;two" in menu_button.toolTip()
    # The next start of the program lists both files again.
    assert len(panel.workbench.library.entries) == 2
    menu_button.menu().aboutToShow.emit()
    actions = menu_button.menu().actions()
    next(action for action in actions if action.text().startswith("a && b")).trigger()
    assert [choice.name for choice in panel.records.chosen] == ["<b>two.csv"]


def test_a_file_without_a_header_is_read_when_its_columns_are_named(
    qtbot, panel, tmp_path, monkeypatch
):
    """A diagnosis that was requested before the file was chosen waits for the names."""
    path, dialogs, diagnoses, finished = tmp_path / "bare.csv", [], [], []
    path.write_text("0,0.1,0.1\n1,0.2,0.2\n2,0.3,0.3\n", "utf-8")
    monkeypatch.setattr(ColumnMappingDialog, "show", lambda dialog: dialogs.append(dialog))
    monkeypatch.setattr(
        panel, "diagnose", lambda: diagnoses.append([run.name for run in panel.records.chosen])
    )
    panel.records.reading_finished.connect(lambda: finished.append(len(panel.records.chosen)))
    for answer, chosen_counts in (
        (ColumnMappingDialog.reject, [0]),
        (ColumnMappingDialog.accept, [0, 1]),
    ):
        panel._diagnose_when_read = True
        panel.records.add_files([path])
        count = len(chosen_counts)
        qtbot.waitUntil(lambda count=count: len(dialogs) == count, timeout=LONG_MS)
        assert len(finished) == count - 1
        dialogs[-1].set_columns("t [s], thx [mrad], thx.meas [mrad]")
        answer(dialogs[-1])
        qtbot.waitUntil(lambda count=count: len(finished) == count, timeout=LONG_MS)
        assert finished == chosen_counts
    assert diagnoses == [["bare.csv"]]


def test_another_robot_is_chosen_and_a_broken_one_is_refused(qtbot, window, panel, tmp_path):
    with qtbot.waitSignal(panel.robots.changed, timeout=LONG_MS):
        panel.robots.load("emps")
    assert panel.robots.robot == load_robot("emps")
    assert panel.robots.currentText() == "emps"
    (tmp_path / "broken.toml").write_text("name = 3")
    panel.robots.load(tmp_path / "broken.toml")
    qtbot.waitUntil(lambda: "broken.toml" in get_newest_notice(window), timeout=LONG_MS)
    assert panel.robots.currentText() == "emps"
    with qtbot.waitSignal(panel.robots.changed, timeout=LONG_MS):
        panel.robots.activated.emit(0)
    assert panel.robots.robot is window.workbench.robot


def test_a_record_beyond_the_range_of_the_model_is_not_diagnosed(window, panel_with_record, record):
    time_s = record.time_s
    positions = 1.2 * ROBOT.axes["thx"].range[1] * np.linspace(0.0, 1.0, len(time_s))
    signals = {("thx", Tap.CMD): positions, ("thx", Tap.MEAS): positions}
    foreign_record = Record.from_signals(time_s, signals, {"thx": "rad"})
    panel_with_record.records.tick_run(ComparedRun("stranger.csv", compare(ROBOT, foreign_record)))
    panel_with_record.diagnose()
    assert not panel_with_record.diagnosing.running
    assert "stranger.csv: thx.cmd" in get_newest_notice(window)
    assert "choose its model under Model" in get_newest_notice(window)


def test_a_diagnosis_runs_in_the_background_and_shows_its_progress(
    qtbot, window, panel_with_record, stepwise_diagnosis, record, monkeypatch
):
    standings = Standings("thx")
    standings.begin(101.0)
    standings.add([AxisEffect(axis="thx", id="creep")], 31.0, Grade.LOOK)
    stepwise_diagnosis.rankings.append(standings.ranking())
    coupling = AxisEffect(axis="thx", id="cross_coupling", from_axis="thy")
    standings.add([AxisEffect(axis="thx", id="hysteresis"), coupling], 2.0, Grade.UNSEEN)
    stepwise_diagnosis.rankings.append(standings.ranking())
    lowered = []
    monkeypatch.setattr(DiagnosisProcess, "lower_priority", lambda process: lowered.append(process))
    click(qtbot, panel_with_record.start)
    qtbot.waitUntil(
        lambda: panel_with_record.doing.text().startswith("fitting θx: hysteresis"), timeout=LONG_MS
    )
    assert panel_with_record.progress.value() == 100
    assert not panel_with_record.start.isEnabled()
    assert stepwise_diagnosis.threads[0] is not threading.main_thread()
    rankings = panel_with_record.result.running.rankings
    qtbot.waitUntil(lambda: list(rankings) == ["thx"], timeout=LONG_MS)
    assert rankings["thx"].accessibleName() == "θx: 1 candidate tried: Creep 70 %"
    assert not lowered
    # Meanwhile a file is saved and an axis moves.
    window.workbench.record = record
    window.workbench.records.save_record(window.workbench.played_folder.parent / "meanwhile.csv")
    wait_until_saved(qtbot, window, window.workbench.played_folder.parent / "meanwhile.csv")
    window.workbench.go_to({"thx": 6e-4})
    snapshot = window.workbench.session.snapshot
    qtbot.waitUntil(lambda: snapshot().command["thx"] == pytest.approx(6e-4), timeout=LONG_MS)
    window.workbench.go_to({"x": 0.02})
    qtbot.waitUntil(lambda: bool(lowered), timeout=LONG_MS)  # motion has priority
    stepwise_diagnosis.steps.release()
    view = rankings["thx"]
    qtbot.waitUntil(lambda: "θx: 2 candidates tried" in view.accessibleName(), timeout=LONG_MS)
    first, second = (name_causes(standing) for standing in view.ranking.standings)
    assert (first, second) == ("Cross coupling from θy + Hysteresis", "Creep")
    assert not view.grab().toImage().isNull()
    stepwise_diagnosis.steps.release()
    qtbot.waitUntil(lambda: panel_with_record.answer is not None, timeout=LONG_MS)
    assert panel_with_record.answer.diagnosis is stepwise_diagnosis.diagnosis
    assert panel_with_record.start.isEnabled()
    assert panel_with_record.progress.isHidden()
    assert panel_with_record.result.running.isHidden()


def test_stop_acts_at_once_and_late_results_are_dropped(
    qtbot, panel_with_record, stepwise_diagnosis
):
    click(qtbot, panel_with_record.start)
    qtbot.waitUntil(lambda: len(stepwise_diagnosis.calls) == 1, timeout=LONG_MS)
    click(qtbot, panel_with_record.stop)
    assert panel_with_record.start.isEnabled()  # although the work still waits in its step
    assert not panel_with_record.stop.isEnabled()
    assert panel_with_record.doing.text() == "The diagnosis was stopped."
    click(qtbot, panel_with_record.start)
    assert panel_with_record.doing.text() == "waiting for the stopped work to end"
    stepwise_diagnosis.steps.release()
    qtbot.waitUntil(lambda: stepwise_diagnosis.ends == ["stopped"], timeout=LONG_MS)
    stepwise_diagnosis.steps.release(2)
    qtbot.waitUntil(lambda: panel_with_record.answer is not None, timeout=LONG_MS)
    assert stepwise_diagnosis.ends == ["stopped", "answered"]


def test_an_answer_that_is_ready_at_the_stop_is_not_shown(
    qtbot, window, panel_with_record, stepwise_diagnosis
):
    click(qtbot, panel_with_record.start)
    qtbot.waitUntil(lambda: len(stepwise_diagnosis.calls) == 1, timeout=LONG_MS)
    stepwise_diagnosis.steps.release(2)
    while panel_with_record.diagnosing.busy:
        if stepwise_diagnosis.ends:
            panel_with_record.diagnosing._background.wait()
            click(qtbot, panel_with_record.stop)
            break
    qtbot.waitUntil(lambda: not panel_with_record.diagnosing.busy, timeout=LONG_MS)
    assert panel_with_record.answer is None


def test_a_failed_diagnosis_becomes_a_notice(qtbot, window, panel_with_record, monkeypatch):
    def refuse(_robot, _records, _listener):
        raise GapError("record 1: too short to tell anything; record 2 s or more")

    replace_diagnosis(monkeypatch, refuse)
    click(qtbot, panel_with_record.start)
    qtbot.waitUntil(lambda: "too short" in get_newest_notice(window), timeout=LONG_MS)
    assert panel_with_record.doing.text().startswith("The diagnosis failed")
    assert panel_with_record.start.isEnabled()


def test_closing_the_window_ends_a_diagnosis(qtbot, window, panel_with_record, monkeypatch):
    running, ended = threading.Event(), threading.Event()

    def diagnose_endlessly(_robot, _records, listener):
        try:
            while True:
                listener(Progress("fitting", "thx", "hysteresis", 0.5))
                running.set()
                ended.wait(0.01)
        except DiagnosisStoppedError:
            ended.set()
            raise

    replace_diagnosis(monkeypatch, diagnose_endlessly)
    click(qtbot, panel_with_record.start)
    qtbot.waitUntil(running.is_set, timeout=LONG_MS)
    window.workbench.close()
    assert ended.is_set()
    assert not panel_with_record.diagnosing.running


def test_the_time_left_is_estimated_and_counts_down():
    progress = Progress("fitting", "thx", "creep", 0.25)
    assert describe_progress(progress, 0.5, 0.6) == "fitting θx: creep"
    assert describe_progress(progress, 10.0, 10.0) == "fitting θx: creep, 10 s, about 30 s left"
    assert describe_progress(progress, 10.0, 25.0) == "fitting θx: creep, 25 s, about 15 s left"
    assert describe_progress(progress, 10.0, 50.0) == "fitting θx: creep, 50 s"
    assert describe_progress(replace(progress, share=0.0), 10.0, 10.0) == "fitting θx: creep, 10 s"


def test_the_where_tab_lists_axes_and_taps_with_a_map_whose_cells_open_traces(
    qtbot, panel_with_answer
):
    distribution = panel_with_answer.result.distribution
    rows = distribution.places.read_texts()
    assert rows[0][0] == "θx ref"
    assert [row[1] for row in rows if row[0].startswith("θy")] == ["noise", "noise"]
    heat = distribution.heat.read_texts()
    assert "Click a cell" in distribution.heat_title.text()
    assert {"reversal", "forward", "backward"} <= {row[0] for row in heat}
    shares = {row[0]: float(row[1].removesuffix(" %").removeprefix("< ")) for row in heat}
    assert shares["fast"] + shares["slow"] + shares["reversal"] == pytest.approx(100.0, abs=3.0)

    row = [texts[0] for texts in heat].index("reversal")
    position = distribution.heat.visualItemRect(distribution.heat.item(row, 2)).center()
    qtbot.mouseClick(distribution.heat.viewport(), Qt.MouseButton.LeftButton, pos=position)
    assert distribution.right.currentWidget() is distribution.cell
    assert distribution.cell.title.text().startswith("θx ref, reversal, ")
    assert distribution.cell.choice.currentText() == "day one.csv"
    assert "rms in" in distribution.cell.legend.text()
    click(qtbot, distribution.cell.back)
    assert distribution.right.currentIndex() == 0
    distribution.open_cell(row, 1)  # the column of shares has no traces
    assert distribution.right.currentIndex() == 0
    distribution.places.selectRow(1)
    assert distribution.heat_title.text().startswith("θx meas")


def test_warmth_rises_from_zero_to_one():
    assert compute_warmth(0.0) == 0.0
    assert 0.0 < compute_warmth(1.0) < compute_warmth(100.0) < 1.0
    assert compute_warmth(1e6) == 1.0


def test_the_other_tabs_rank_candidates_and_show_the_gap_before_and_after(
    qtbot, window, panel_with_answer
):
    result = panel_with_answer.result
    result.tabs.setCurrentIndex(WHICH_TAB)
    assert result.views.currentWidget() is result.causes
    assert result.causes.ranking.read_texts()[0] == [
        "Hysteresis (prandtl ishlinskii)",
        "91 %",
        "1.2",
        "1.1 … 1.3",
    ]
    text = result.causes.text.toPlainText()
    assert "These records cannot distinguish it from creep." in text
    assert "width: 120 µrad (110 µrad … 130 µrad), at its high bound" in text
    assert (
        result.headline.sentence.text()
        == "θx: hysteresis or creep (these records cannot distinguish them)."
    )

    result.tabs.setCurrentIndex(HOW_FAR_TAB)
    assert [(bar.name, bar.text) for bar in result.shrinkage.bars.bars] == [
        ("nominal", "33 µrad"),
        ("re-tuned", "32 µrad"),
        ("+ Hysteresis", "0.78 µrad, 42.3 × smaller"),
        ("corrected", "0.77 µrad, 42.9 × smaller"),
    ]
    assert [line.text for line in result.shrinkage.bars.lines] == ["0.4 µrad"]
    assert result.shrinkage.traces.choice.currentText() == "day one.csv: meas"
    before, after = (
        np.asarray(result.shrinkage.traces.plot._curves[name].getData()[1])
        for name in ("before", "after")
    )
    assert np.std(before) > 10 * np.std(after) > 0.0

    for theme in ("light", "dark"):
        window.use_theme(theme)
        for tab in (WHERE_TAB, WHICH_TAB, HOW_FAR_TAB, PROOF_TAB):
            result.tabs.setCurrentIndex(tab)
            assert not panel_with_answer.grab().toImage().isNull()
        colour = result.causes.ranking.item(1, 0).foreground().color().name()
        assert colour == window.workbench.theme.quiet
    click(qtbot, result.cells.cards[1])
    assert result.shrinkage.bars.bars == ()
    assert result.shrinkage.title.text() == "This axis has no gap to close."


def show_suggested_experiment(panel, diagnosis, record):
    """Give the panel an answer that suggests an experiment; return its commands."""
    command = record.signal("thx", Tap.CMD)
    experiment = SuggestedExperiment(
        axis="thx",
        splits=("hysteresis", "creep"),
        why=message("gap", "A long hold parts them."),
        time_s=tuple(record.time_s),
        commands={"thx": tuple(command)},
        predictions={"hysteresis": tuple(command), "creep": tuple(command)},
    )
    diagnosis_with_experiment = replace(diagnosis, experiments=(experiment,))
    panel.take_answer(
        DiagnosisAnswer.from_diagnosis(diagnosis_with_experiment, ["day one.csv"], [record])
    )
    return command


def test_a_suggested_experiment_is_played_and_diagnosed_with_the_old_records(
    qtbot, window, panel_with_answer, diagnosis, record, stepwise_diagnosis
):
    assert panel_with_answer.result.plan.isHidden()
    command = show_suggested_experiment(panel_with_answer, diagnosis, record)
    text = panel_with_answer.result.causes.text.toPlainText()
    assert "Next experiment: A long hold parts them." in text
    assert "Press “Play next experiment …” to distinguish them." in text
    click(qtbot, panel_with_answer.result.plan)
    click(qtbot, find_question(window).button(QMessageBox.StandardButton.No))
    assert window.workbench.plan is None  # "No" loads no plan
    click(qtbot, panel_with_answer.result.plan)
    box = next(child for child in window.findChildren(QMessageBox) if child.isVisible())
    assert "θx: " in box.informativeText()
    assert "µrad" in box.informativeText()
    click(qtbot, box.button(QMessageBox.StandardButton.Yes))
    qtbot.waitUntil(lambda: len(stepwise_diagnosis.calls) == 1, timeout=LONG_MS)
    assert window.workbench.plan.trajectory.signal("thx", Tap.CMD) == pytest.approx(command)
    names = [choice.name for choice in panel_with_answer.records.chosen]
    assert names == ["day one.csv", "gap_experiment_1.csv"]
    assert len(stepwise_diagnosis.calls[0][1]) == 2
    panel_with_answer.stop_diagnosis()


def test_a_run_played_after_an_answer_shows_its_gap_reduction(window, qtbot, panel_with_answer):
    assert panel_with_answer.result.unseen_motion.currentIndex() == 0  # the hint
    workbench, record = window.workbench, panel_with_answer.answer.records[0]
    workbench.run_changed.emit(ComparedRun("tuesday", compare(workbench.robot, record)))
    qtbot.waitUntil(
        lambda: panel_with_answer.result.unseen_motion.latest is not None, timeout=LONG_MS
    )
    first_row = panel_with_answer.result.unseen_motion.table.read_texts()[0]
    assert first_row[:2] == ["tuesday", "θx meas"]
    assert panel_with_answer.result.unseen_motion.latest.reductions[0].factor > 5.0
    assert first_row[4].startswith("better: ")
    assert first_row[4].endswith("× smaller")
    assert panel_with_answer.result.tabs.currentIndex() == WHERE_TAB  # no tab is opened unasked


def test_a_new_motion_needs_a_confirmation(qtbot, window, panel_with_answer):
    click(qtbot, panel_with_answer.result.motion)
    qtbot.waitUntil(lambda: find_question(window) is not None, timeout=LONG_MS)
    click(qtbot, find_question(window).button(QMessageBox.StandardButton.No))
    assert window.workbench.plan is None


def test_an_answer_is_saved_as_json_and_as_a_report_that_is_opened(
    qtbot, window, panel_with_answer, diagnosis, tmp_path, monkeypatch
):
    answer, exports, opened = panel_with_answer.answer, panel_with_answer.exports, []
    exports.save_json(answer, tmp_path / "gap.json")
    wait_until_saved(qtbot, window, tmp_path / "gap.json")
    assert json.loads((tmp_path / "gap.json").read_text("utf-8")) == as_json(diagnosis)
    exports.save_json(answer, tmp_path)
    qtbot.waitUntil(lambda: "is a folder" in get_newest_notice(window), timeout=LONG_MS)

    def write(_diagnosis, _records, path, names, _run):
        path.write_text(", ".join(names), "utf-8")

    monkeypatch.setattr(answer_exports, "write_report", write)  # the report has other tests
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: bool(opened.append(url)))
    exports.save_report(answer, tmp_path / "gap.html")
    wait_until_saved(qtbot, window, tmp_path / "gap.html")
    assert "day one.csv" in (tmp_path / "gap.html").read_text("utf-8")
    assert [url.toLocalFile() for url in opened] == [str(tmp_path / "gap.html")]
    # Here nothing can open a page.
    qtbot.waitUntil(lambda: "open it in a browser" in get_newest_notice(window), timeout=LONG_MS)


def test_the_twin_is_saved_as_a_robot_file_without_changing_the_simulator(
    qtbot, window, panel_with_record, diagnosis, record, tmp_path
):
    text = "# our machine\n" + format_robot(window.workbench.robot)
    (tmp_path / "ours.toml").write_text(text, "utf-8")
    with qtbot.waitSignal(panel_with_record.robots.changed, timeout=LONG_MS):
        panel_with_record.robots.load(tmp_path / "ours.toml")
    panel_with_record.take_answer(
        DiagnosisAnswer.from_diagnosis(diagnosis, ["day one.csv"], [record])
    )
    panel_with_record.exports.save_twin(
        panel_with_record.answer, panel_with_record._source, tmp_path / "twin.toml"
    )
    wait_until_saved(qtbot, window, tmp_path / "twin.toml")
    assert (tmp_path / "twin.toml").read_text("utf-8").startswith("# our machine\n")
    twin = load_robot(tmp_path / "twin.toml")
    assert twin.effects == diagnosis.fitted
    # The twin is now the model of the page.
    qtbot.waitUntil(lambda: panel_with_record.robots.robot == twin, timeout=LONG_MS)
    assert find_question(window) is None
    assert window.workbench.session.service.effects == ()
