"""The gap page: what an operator chooses, sees and does, and that nothing waits for it."""

import json
import threading
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog, QMessageBox

from rotemina.app.shell.first_steps import FirstSteps
from rotemina.app.shell.workbench import Run
from rotemina.plugins.gap import answer_exports
from rotemina.plugins.gap.diagnosing import StoppedError, said
from rotemina.plugins.gap.diagnosis_answer import Answer
from rotemina.plugins.gap.diagnosis_process import DiagnosisProcess
from rotemina.plugins.gap.distribution_view import warmth
from rotemina.plugins.gap.ranking_view import name_of
from rotemina.plugins.gap.unseen_motion_reduction import new_motion
from rotemina.sim.comparison.comparison import compare
from rotemina.sim.gap.compare.diagnosis_progress import Progress
from rotemina.sim.gap.compare.ranking import Grade, Standings
from rotemina.sim.gap.diagnosis import Experiment
from rotemina.sim.gap.errors import GapError
from rotemina.sim.gap.output.document import as_json
from rotemina.sim.messages import message
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.robot.writing import robot_text
from rotemina.sim.trajectory.dry_run import dry_run

ROBOT = load_robot("rotemina")
LONG_MS = 30_000
WHERE, WHICH, FAR, PROOF = range(4)


class Stepwise:
    """A diagnosis that takes a step when it is let; it tells where it ran and how it ended."""

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
        except StoppedError:
            self.ends.append("stopped")
            raise
        self.ends.append("answered")
        return self.diagnosis


def use(monkeypatch, diagnose):
    """Let a function diagnose, on the thread that would wait for the process."""

    def answer(_self, robot, names, records, listener):
        return Answer.of(diagnose(robot, records, listener), names, records)

    monkeypatch.setattr(DiagnosisProcess, "answer", answer)


@pytest.fixture
def stepwise(monkeypatch, diagnosis):
    made = Stepwise(diagnosis)
    use(monkeypatch, made)
    yield made
    made.steps.release(100)


def click(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def question(window):
    boxes = [box for box in window.findChildren(QMessageBox) if box.isVisible()]
    return boxes[0] if boxes else None


def newest(window):
    return window.told[-1] if window.told else ""


def saved(qtbot, window, path):
    qtbot.waitUntil(lambda: f"Saved {path}" in window.told, timeout=LONG_MS)


# --- choosing ---------------------------------------------------------------------------------


def test_without_records_the_page_says_what_to_do_first(panel):
    assert panel.result.views.currentWidget() is panel.result.hint
    assert panel.result.hint.text().startswith("1  Choose records")
    assert panel.start.text() == "Diagnose …"  # which asks for records first
    for button in (panel.stop, panel.result.twin, panel.result.motion, panel.result.report):
        assert not button.isEnabled()
        assert "Not now: " in button.toolTip()
    assert panel.result.tabs.isHidden()
    panel.diagnose()  # by the palette or a script
    assert not panel.diagnosing.running


def test_diagnose_without_records_asks_for_files_and_goes_on(
    qtbot, window, panel, stepwise, record, tmp_path
):
    write_record(record, tmp_path / "one.csv")
    write_record(record, tmp_path / "two.csv")
    click(qtbot, panel.start)
    dialog = next(d for d in window.findChildren(QFileDialog) if d.isVisible())
    dialog.close()
    panel.records.add_files([tmp_path / "one.csv", tmp_path / "two.csv"])
    qtbot.waitUntil(lambda: len(stepwise.calls) == 1, timeout=LONG_MS)
    assert len(stepwise.calls[0][1]) == 2  # not before both were read
    assert panel.result.views.currentWidget() is panel.result.running
    panel.end()


def test_diagnose_among_the_first_steps_is_one_click(qtbot, panel, stepwise, record):
    bench = panel.workbench
    bench.run_changed.emit(Run("played", compare(bench.robot, record)))
    card = FirstSteps(bench)
    qtbot.addWidget(card)
    for _ in range(2):  # the second finds one that runs
        card.diagnose.click()
        assert panel.diagnosing.running
    qtbot.waitUntil(lambda: bool(stepwise.calls), timeout=LONG_MS)
    panel.end()
    assert len(stepwise.calls) == 1


def test_the_last_playback_is_taken_until_something_else_is_chosen(panel, record):
    bench = panel.workbench
    first, second = (Run(name, compare(bench.robot, record)) for name in ("first", "second"))
    bench.run_changed.emit(first)
    bench.run_changed.emit(second)
    assert [each.name for each in panel.records.chosen] == ["second"]
    assert panel.start.isEnabled()
    panel.records.take(first)
    bench.run_changed.emit(second)
    assert [each.name for each in panel.records.chosen] == ["first"]


def test_files_are_added_and_ticked_by_the_menu(qtbot, window, panel, record, tmp_path):
    paths = [tmp_path / name for name in ("a & b.csv", "<b>two.csv")]
    for path in paths:
        write_record(record, path)
    panel.records.add_files(paths)
    qtbot.waitUntil(lambda: len(panel.records.chosen) == 2, timeout=LONG_MS)
    qtbot.waitUntil(lambda: all(one.entry for one in panel.records.chosen), timeout=LONG_MS)
    choice = panel.rail.menu
    assert choice.text() == "2 records"
    assert "&lt;b&gt;two" in choice.toolTip()
    assert len(panel.workbench.library.entries) == 2  # another start finds them again
    choice.menu().aboutToShow.emit()
    answer_exports = choice.menu().actions()
    next(one for one in answer_exports if one.text().startswith("a && b")).trigger()
    assert [each.name for each in panel.records.chosen] == ["<b>two.csv"]


def test_a_file_that_cannot_be_read_or_needs_names_becomes_a_notice(
    qtbot, window, panel, record, tmp_path
):
    (tmp_path / "bare.csv").write_text("0,1\n1,2\n2,3\n")
    write_record(record, tmp_path / "good.csv")
    panel.records.add_files([tmp_path / "bare.csv", tmp_path / "good.csv"])
    qtbot.waitUntil(lambda: "no header" in newest(window), timeout=LONG_MS)
    qtbot.waitUntil(lambda: len(panel.records.chosen) == 1, timeout=LONG_MS)
    panel.records.add_files([tmp_path / "missing.csv"])
    qtbot.waitUntil(lambda: "missing.csv" in newest(window), timeout=LONG_MS)


def test_another_robot_is_chosen_and_a_broken_one_refused(qtbot, window, panel, tmp_path):
    with qtbot.waitSignal(panel.robots.changed, timeout=LONG_MS):
        panel.robots.load("emps")
    assert panel.robots.robot == load_robot("emps")
    assert panel.robots.currentText() == "emps"
    (tmp_path / "broken.toml").write_text("name = 3")
    panel.robots.load(tmp_path / "broken.toml")
    qtbot.waitUntil(lambda: "broken.toml" in newest(window), timeout=LONG_MS)
    assert panel.robots.currentText() == "emps"
    with qtbot.waitSignal(panel.robots.changed, timeout=LONG_MS):
        panel.robots.activated.emit(0)
    assert panel.robots.robot is window.workbench.robot


def test_a_record_of_another_machine_is_not_diagnosed(window, chosen, record):
    time_s = record.time_s
    far = 1.2 * ROBOT.axes["thx"].range[1] * np.linspace(0.0, 1.0, len(time_s))
    signals = {("thx", Tap.CMD): far, ("thx", Tap.MEAS): far}
    stranger = Record.from_signals(time_s, signals, {"thx": "rad"})
    chosen.records.take(Run("stranger.csv", compare(ROBOT, stranger)))
    chosen.diagnose()
    assert not chosen.diagnosing.running
    assert "stranger.csv: thx.cmd" in newest(window)
    assert "choose its model under Model" in newest(window)


# --- running ----------------------------------------------------------------------------------


def test_a_diagnosis_runs_beside_the_window_and_tells_how_far_it_is(
    qtbot, window, chosen, stepwise, record, monkeypatch
):
    stood_back = []
    monkeypatch.setattr(DiagnosisProcess, "stand_back", lambda one: stood_back.append(one))
    click(qtbot, chosen.start)
    qtbot.waitUntil(
        lambda: chosen.doing.text().startswith("fitting θx: hysteresis"), timeout=LONG_MS
    )
    assert chosen.progress.value() == 100
    assert not chosen.start.isEnabled()
    assert stepwise.threads[0] is not threading.main_thread()
    assert not stood_back
    # What must not wait, does not: a file is written and motion goes on meanwhile.
    window.workbench.record = record
    window.workbench.save_record(window.workbench.played_folder.parent / "meanwhile.csv")
    saved(qtbot, window, window.workbench.played_folder.parent / "meanwhile.csv")
    window.workbench.go_to({"thx": 6e-4})
    snapshot = window.workbench.session.snapshot
    qtbot.waitUntil(lambda: snapshot().command["thx"] == pytest.approx(6e-4), timeout=LONG_MS)
    window.workbench.go_to({"x": 0.02})
    qtbot.waitUntil(lambda: bool(stood_back), timeout=LONG_MS)  # for what moves
    stepwise.steps.release(2)
    qtbot.waitUntil(lambda: chosen.answer is not None, timeout=LONG_MS)
    assert chosen.answer.diagnosis is stepwise.diagnosis
    assert chosen.start.isEnabled()
    assert chosen.progress.isHidden()


def test_candidates_rank_while_a_diagnosis_runs(qtbot, chosen, stepwise):
    standings = Standings("thx")
    standings.begin(101.0)
    standings.add([AxisEffect(axis="thx", id="creep")], 31.0, Grade.LOOK)
    stepwise.rankings.append(standings.ranking())
    coupled = AxisEffect(axis="thx", id="cross_coupling", from_axis="thy")
    standings.add([AxisEffect(axis="thx", id="hysteresis"), coupled], 2.0, Grade.UNSEEN)
    stepwise.rankings.append(standings.ranking())
    click(qtbot, chosen.start)
    qtbot.waitUntil(lambda: list(chosen.result.running.rankings) == ["thx"], timeout=LONG_MS)
    view = chosen.result.running.rankings["thx"]
    assert view.accessibleName() == "θx: 1 candidate tried: Creep 70 %"
    stepwise.steps.release()
    qtbot.waitUntil(lambda: "θx: 2 candidates tried" in view.accessibleName(), timeout=LONG_MS)
    first, second = (name_of(one) for one in view.ranking.standings)
    assert (first, second) == ("Cross coupling from θy + Hysteresis", "Creep")
    assert not view.grab().toImage().isNull()
    stepwise.steps.release()
    qtbot.waitUntil(lambda: chosen.answer is not None, timeout=LONG_MS)
    assert chosen.result.running.isHidden()


def test_stop_works_at_once_and_what_comes_late_is_dropped(qtbot, chosen, stepwise):
    click(qtbot, chosen.start)
    qtbot.waitUntil(lambda: len(stepwise.calls) == 1, timeout=LONG_MS)
    click(qtbot, chosen.stop)
    assert chosen.start.isEnabled()  # although the work has not come to its next step yet
    assert not chosen.stop.isEnabled()
    assert chosen.doing.text() == "The diagnosis was stopped."
    click(qtbot, chosen.start)
    assert chosen.doing.text() == "waiting for the stopped work to end"
    stepwise.steps.release()
    qtbot.waitUntil(lambda: stepwise.ends == ["stopped"], timeout=LONG_MS)
    stepwise.steps.release(2)
    qtbot.waitUntil(lambda: chosen.answer is not None, timeout=LONG_MS)
    assert stepwise.ends == ["stopped", "answered"]


def test_an_answer_that_was_ready_when_it_was_stopped_is_not_shown(qtbot, window, chosen, stepwise):
    click(qtbot, chosen.start)
    qtbot.waitUntil(lambda: len(stepwise.calls) == 1, timeout=LONG_MS)
    stepwise.steps.release(2)
    while chosen.diagnosing.busy:
        if stepwise.ends:
            chosen.diagnosing._background.wait()
            click(qtbot, chosen.stop)
            break
    qtbot.waitUntil(lambda: not chosen.diagnosing.busy, timeout=LONG_MS)
    assert chosen.answer is None


def test_records_that_cannot_be_diagnosed_become_a_notice(qtbot, window, chosen, monkeypatch):
    def refuse(_robot, _records, _listener):
        raise GapError("record 1: too short to tell anything; record 2 s or more")

    use(monkeypatch, refuse)
    click(qtbot, chosen.start)
    qtbot.waitUntil(lambda: "too short" in newest(window), timeout=LONG_MS)
    assert chosen.doing.text().startswith("The diagnosis failed")
    assert chosen.start.isEnabled()


def test_closing_the_window_ends_a_diagnosis(qtbot, window, chosen, monkeypatch):
    under_way, ended = threading.Event(), threading.Event()

    def endless(_robot, _records, listener):
        try:
            while True:
                listener(Progress("fitting", "thx", "hysteresis", 0.5))
                under_way.set()
                ended.wait(0.01)
        except StoppedError:
            ended.set()
            raise

    use(monkeypatch, endless)
    click(qtbot, chosen.start)
    qtbot.waitUntil(under_way.is_set, timeout=LONG_MS)
    window.workbench.close()
    assert ended.is_set()
    assert not chosen.diagnosing.running


def test_the_time_left_is_told_once_it_can_be_guessed_and_runs_down():
    progress = Progress("fitting", "thx", "creep", 0.25)
    assert said(progress, 0.5, 0.6) == "fitting θx: creep"
    assert said(progress, 10.0, 10.0) == "fitting θx: creep, 10 s, about 30 s left"
    assert said(progress, 10.0, 25.0) == "fitting θx: creep, 25 s, about 15 s left"
    assert said(progress, 10.0, 50.0) == "fitting θx: creep, 50 s"
    assert said(replace(progress, share=0.0), 10.0, 10.0) == "fitting θx: creep, 10 s"


# --- showing ----------------------------------------------------------------------------------


def test_where_names_axes_taps_and_shares_with_a_map_of_the_chosen_one(answered):
    rows = answered.result.distribution.places.texts()
    assert rows[0][0] == "θx ref"
    assert [row[1] for row in rows if row[0].startswith("θy")] == ["noise", "noise"]
    heat = answered.result.distribution.heat.texts()
    assert "Click a cell" in answered.result.distribution.heat_title.text()
    assert {"reversal", "forward", "backward"} <= {row[0] for row in heat}
    shares = {row[0]: float(row[1].removesuffix(" %").removeprefix("< ")) for row in heat}
    assert shares["fast"] + shares["slow"] + shares["reversal"] == pytest.approx(100.0, abs=3.0)
    answered.result.distribution.places.selectRow(1)
    assert answered.result.distribution.heat_title.text().startswith("θx meas")


def test_warmth_goes_from_none_to_all():
    assert warmth(0.0) == 0.0
    assert 0.0 < warmth(1.0) < warmth(100.0) < 1.0
    assert warmth(1e6) == 1.0


def test_which_ranks_candidates_and_says_what_cannot_be_told_apart(answered):
    answered.result.tabs.setCurrentIndex(WHICH)
    assert answered.result.views.currentWidget() is answered.result.causes
    assert answered.result.causes.ranking.texts()[0] == [
        "Hysteresis (prandtl ishlinskii)",
        "91 %",
        "1.2",
        "1.1 … 1.3",
    ]
    text = answered.result.causes.text.toPlainText()
    assert "These records cannot distinguish it from creep." in text
    assert "width: 120 µrad (110 µrad … 130 µrad), at its high bound" in text
    assert (
        answered.result.headline.sentence.text()
        == "θx: hysteresis or creep (these records cannot distinguish them)."
    )


def test_how_far_shows_bars_and_the_gap_before_and_after(qtbot, answered):
    answered.result.tabs.setCurrentIndex(FAR)
    assert [(bar.name, bar.text) for bar in answered.result.shrinkage.bars.bars] == [
        ("nominal", "33 µrad"),
        ("re-tuned", "32 µrad"),
        ("+ Hysteresis", "0.78 µrad, 42.3 × smaller"),
        ("corrected", "0.77 µrad, 42.9 × smaller"),
    ]
    assert [line.text for line in answered.result.shrinkage.bars.lines] == ["0.4 µrad"]
    assert not answered.result.shrinkage.bars.grab().toImage().isNull()
    assert answered.result.shrinkage.traces.choice.currentText() == "day one.csv: meas"
    before, after = (
        np.asarray(answered.result.shrinkage.traces.plot._curves[name].getData()[1])
        for name in ("before", "after")
    )
    assert np.std(before) > 10 * np.std(after) > 0.0
    click(qtbot, answered.result.cells.cells[1])
    assert answered.result.shrinkage.bars.bars == ()
    assert answered.result.shrinkage.title.text() == "This axis has no gap to close."


def test_another_theme_recolours_everything(window, answered):
    for theme in ("light", "dark"):
        window.use_theme(theme)
        for view in (WHERE, WHICH, FAR, PROOF):
            answered.result.tabs.setCurrentIndex(view)
            assert not answered.grab().toImage().isNull()
    quiet = answered.workbench.theme.quiet
    assert answered.result.causes.ranking.item(1, 0).foreground().color().name() == quiet


def test_a_cell_of_the_map_leads_to_its_traces_and_back(qtbot, answered):
    where = answered.result.distribution
    texts = where.heat.texts()
    row = next(n for n, each in enumerate(texts) if each[0] == "reversal")
    place = where.heat.visualItemRect(where.heat.item(row, 2)).center()
    qtbot.mouseClick(where.heat.viewport(), Qt.MouseButton.LeftButton, pos=place)
    assert where.right.currentWidget() is where.cell
    assert where.cell.title.text().startswith("θx ref, reversal, ")
    assert where.cell.choice.currentText() == "day one.csv"
    assert "rms in" in where.cell.legend.text()
    click(qtbot, where.cell.back)
    assert where.right.currentIndex() == 0
    where.open_cell(row, 1)  # a share has no traces of its own
    assert where.right.currentIndex() == 0


def experimental(panel, diagnosis, record):
    """Give the panel an answer that suggests an experiment; return its commands."""
    command = record.signal("thx", Tap.CMD)
    experiment = Experiment(
        axis="thx",
        splits=("hysteresis", "creep"),
        why=message("gap", "A long hold parts them."),
        time_s=tuple(record.time_s),
        commands={"thx": tuple(command)},
        predictions={"hysteresis": tuple(command), "creep": tuple(command)},
    )
    suggested = replace(diagnosis, experiments=(experiment,))
    panel.take_answer(Answer.of(suggested, ["day one.csv"], [record]))
    return command


def test_a_suggested_experiment_is_played_after_a_question_and_diagnosed_with_the_old_records(
    qtbot, window, answered, diagnosis, record, stepwise
):
    assert answered.result.plan.isHidden()
    command = experimental(answered, diagnosis, record)
    text = answered.result.causes.text.toPlainText()
    assert "Next experiment: A long hold parts them." in text
    assert "Press “Play next experiment …” to distinguish them." in text
    click(qtbot, answered.result.plan)
    click(qtbot, question(window).button(QMessageBox.StandardButton.No))
    assert window.workbench.plan is None  # nothing is taken in hand unasked
    click(qtbot, answered.result.plan)
    box = next(each for each in window.findChildren(QMessageBox) if each.isVisible())
    assert "θx: " in box.informativeText()
    assert "µrad" in box.informativeText()
    click(qtbot, box.button(QMessageBox.StandardButton.Yes))
    qtbot.waitUntil(lambda: len(stepwise.calls) == 1, timeout=LONG_MS)
    assert window.workbench.plan.trajectory.signal("thx", Tap.CMD) == pytest.approx(command)
    names = [each.name for each in answered.records.chosen]
    assert names == ["day one.csv", "gap_experiment_1.csv"]
    assert len(stepwise.calls[0][1]) == 2
    answered.end()


def test_what_is_played_after_an_answer_shows_how_far_its_gap_has_shrunk(window, qtbot, answered):
    assert answered.result.proof.currentIndex() == 0  # what to do to see anything here
    bench, record = window.workbench, answered.answer.records[0]
    bench.run_changed.emit(Run("tuesday", compare(bench.robot, record)))
    qtbot.waitUntil(lambda: answered.result.proof.proof is not None, timeout=LONG_MS)
    first = answered.result.proof.table.texts()[0]
    assert first[:2] == ["tuesday", "θx meas"]
    assert answered.result.proof.proof.shrunk[0].times > 5.0
    assert first[4].startswith("better: ")
    assert first[4].endswith("× smaller")
    assert answered.result.tabs.currentIndex() == WHERE  # it was not asked for here


def test_a_new_motion_stays_where_the_records_went_and_is_asked_about(
    qtbot, window, answered, diagnosis, record
):
    click(qtbot, answered.result.motion)
    qtbot.waitUntil(lambda: question(window) is not None, timeout=LONG_MS)
    click(qtbot, question(window).button(QMessageBox.StandardButton.No))
    motion = new_motion(diagnosis, [record], ["thx", "thy"])
    assert dry_run(ROBOT, motion).allowed
    for axis in ("thx", "thy"):
        way, known = motion.signal(axis, Tap.CMD), record.signal(axis, Tap.CMD)
        assert known.min() <= way.min() < way.max() <= known.max()


# --- acting -----------------------------------------------------------------------------------


def test_json_holds_the_diagnosis(qtbot, window, answered, diagnosis, tmp_path):
    answered.actions_of.save_json(answered.answer, tmp_path / "gap.json")
    saved(qtbot, window, tmp_path / "gap.json")
    assert json.loads((tmp_path / "gap.json").read_text("utf-8")) == as_json(diagnosis)


def test_the_report_is_written_and_opened(qtbot, window, answered, tmp_path, monkeypatch):
    opened = []

    def write(_diagnosis, _records, path, names, _run):
        path.write_text(", ".join(names), "utf-8")

    monkeypatch.setattr(answer_exports, "write_report", write)  # which has tests of its own
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: opened.append(url) or True)
    answered.actions_of.save_report(answered.answer, tmp_path / "gap.html")
    saved(qtbot, window, tmp_path / "gap.html")
    assert "day one.csv" in (tmp_path / "gap.html").read_text("utf-8")
    assert [url.toLocalFile() for url in opened] == [str(tmp_path / "gap.html")]


def test_a_report_that_nothing_opens_is_told(qtbot, window, answered, tmp_path, monkeypatch):
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda _url: False)
    monkeypatch.setattr(answer_exports, "write_report", lambda *_: None)
    answered.actions_of.save_report(answered.answer, tmp_path / "gap.html")
    qtbot.waitUntil(lambda: "open it in a browser" in newest(window), timeout=LONG_MS)


def test_a_place_that_cannot_be_written_becomes_a_notice(qtbot, window, answered, tmp_path):
    answered.actions_of.save_json(answered.answer, tmp_path)
    qtbot.waitUntil(lambda: "is a folder" in newest(window), timeout=LONG_MS)


def test_the_twin_is_a_robot_file_and_the_simulated_machine_stays_what_it_is(
    qtbot, window, answered, diagnosis, tmp_path
):
    answered.actions_of.save_twin(answered.answer, None, tmp_path / "twin.toml")
    saved(qtbot, window, tmp_path / "twin.toml")
    twin = load_robot(tmp_path / "twin.toml")
    assert twin.effects == diagnosis.fitted
    qtbot.waitUntil(lambda: answered.robots.robot == twin, timeout=LONG_MS)  # the model from now on
    assert question(window) is None
    assert window.workbench.session.service.effects == ()


def test_the_twin_of_a_robot_file_keeps_its_comments(
    qtbot, window, chosen, diagnosis, record, tmp_path
):
    text = "# our machine\n" + robot_text(window.workbench.robot)
    (tmp_path / "ours.toml").write_text(text, "utf-8")
    with qtbot.waitSignal(chosen.robots.changed, timeout=LONG_MS):
        chosen.robots.load(tmp_path / "ours.toml")
    chosen.take_answer(Answer.of(diagnosis, ["day one.csv"], [record]))
    chosen.actions_of.save_twin(chosen.answer, chosen._source, tmp_path / "twin.toml")
    saved(qtbot, window, tmp_path / "twin.toml")
    assert (tmp_path / "twin.toml").read_text("utf-8").startswith("# our machine\n")
