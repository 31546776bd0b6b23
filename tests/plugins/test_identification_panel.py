"""The identification page: what an operator chooses and sees, and that nothing waits for it."""

import csv
import threading
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QGuiApplication

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.widgets.controls import why_not
from rotemina.plugins.identification.excitation import Wave
from rotemina.plugins.identification.excite_view import CHECKING
from rotemina.plugins.identification.export import as_csv
from rotemina.plugins.identification.findings import Findings
from rotemina.plugins.identification.panel import EXCITE_WIDTH
from rotemina.plugins.identification.views import LOOKS, View
from rotemina.plugins.trajectory.speed_limit_dialog import SpeedLimitDialog
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.robot.writing import write_robot

LONG_MS = 30_000
RATE_HZ = 12_800.0


@pytest.fixture(scope="module")
def record():
    """The mirror's m1 (1000 Hz, damping ratio 0.02) under noise; m2 is commanded alone."""
    time_s = np.arange(8192) / RATE_HZ
    command = 1e-6 * np.random.default_rng(3).uniform(-1.0, 1.0, 8192)
    signals = {("m1", Tap.CMD): command, ("m2", Tap.CMD): np.zeros(8192)}
    units = {"m1": "m", "m2": "m"}
    answer = nominal_response(
        load_robot("fsm"), Record.from_signals(time_s, signals, units)
    ).signals
    signals[("m1", Tap.U)] = answer["m1", Tap.U]
    signals[("m1", Tap.MEAS)] = answer["m1", Tap.MEAS]
    return Record.from_signals(time_s, signals, units)


@pytest.fixture
def bench_window(make_robot_window):
    return make_robot_window("fsm")


@pytest.fixture
def panel(bench_window):
    return bench_window.panels["identification"]


@pytest.fixture
def answers_of(qtbot):
    """Wait until a panel shows an answer."""

    def wait(panel):
        qtbot.waitUntil(lambda: panel.findings is not None, timeout=LONG_MS)
        return panel.findings

    return wait


@pytest.fixture
def answers(panel, answers_of):
    """Wait until the panel shows an answer."""
    return lambda: answers_of(panel)


@pytest.fixture
def held_up(monkeypatch):
    """A view whose work waits until it is released; it tells the threads that it ran on."""
    release, threads = threading.Event(), []

    def look(question):
        threads.append(threading.current_thread())
        release.wait(20.0)
        return Findings(question, notices=(f"late: {question.drive}",))

    monkeypatch.setitem(LOOKS, View.FREQUENCY, look)
    yield release, threads
    release.set()


def choose(choice, data):
    index = choice.findData(data)
    assert index >= 0
    choice.setCurrentIndex(index)
    choice.activated.emit(index)


def figure(panel, name):
    for row in range(panel.sheet.rowCount()):
        if panel.sheet.item(row, 0).text() == name:
            return float(panel.sheet.item(row, 1).text().split()[0])
    raise AssertionError(f"{name} is not shown")


def shown_charts(panel):
    return [chart for chart in panel.charts if not chart.isHidden()]


def test_without_a_record_it_says_what_to_do(panel):
    assert "open a record" in panel.summary.text()
    assert not panel.controls.copy.isEnabled()
    assert not panel.controls.save.isEnabled()
    assert shown_charts(panel) == []


def test_every_view_shows_what_the_robot_is(qtbot, panel, answers, record):
    panel.take_record("noise", record)
    answers()
    assert figure(panel, "resonance") == pytest.approx(1000.0, rel=2e-3)
    assert len(shown_charts(panel)) == 3
    panel.controls.view.setCurrentIndex(panel.controls.view.findData(View.MODEL))
    answers()
    assert figure(panel, "natural frequency") == pytest.approx(1000.0, rel=1e-4)
    assert figure(panel, "damping ratio") == pytest.approx(0.02, rel=1e-3)
    assert figure(panel, "fit") > 99.9
    assert panel.notices.isHidden()
    panel.controls.view.setCurrentIndex(panel.controls.view.findData(View.STEPS))
    answers()
    assert "holds no jump" in panel.notices.toPlainText()
    assert not panel.notices.isHidden()


def test_an_opened_record_is_taken_with_the_comparison(
    qtbot, bench_window, panel, answers, record, tmp_path
):
    path = tmp_path / "noise.csv"
    write_record(record, path)
    with qtbot.waitSignal(bench_window.workbench.run_changed, timeout=LONG_MS):
        bench_window.workbench.open_record(path)
    assert answers().question.record is bench_window.workbench.run.record
    assert "noise.csv" in panel.summary.text()


def test_the_page_opens_records_that_cannot_be_compared(qtbot, make_robot_window, tmp_path):
    panel = make_robot_window("emps").panels["identification"]
    rng, time_s = np.random.default_rng(1), np.arange(2000) / 1000.0
    command = 0.1 + 1e-3 * rng.standard_normal(2000)
    taps = {("q", Tap.CMD): command, ("q", Tap.MEAS): command + 1e-5 * rng.standard_normal(2000)}
    path = tmp_path / "no voltage.csv"
    write_record(Record.from_signals(time_s, taps, {"q": "m"}), path)
    panel.open_record(path)
    qtbot.waitUntil(lambda: panel.findings is not None, timeout=LONG_MS)
    assert (
        "The nominal model is not shown: axis 'q' is moved by a force"
        in panel.notices.toPlainText()
    )
    assert figure(panel, "gain, lowest line") == pytest.approx(1.0, abs=0.05)


def test_a_file_that_cannot_be_read_is_named_in_the_panel(qtbot, panel, tmp_path):
    path = tmp_path / "spoilt.csv"
    path.write_text("t [s], m1.cmd [um], m1.meas [um]\n0, 1, 2\n1, x, 3\n", "utf-8")
    panel.open_record(path)
    qtbot.waitUntil(lambda: not panel.notices.isHidden(), timeout=LONG_MS)
    assert "spoilt.csv:3" in panel.notices.toPlainText()


def test_an_axis_without_an_answer_is_named(qtbot, panel, answers, record):
    panel.take_record("noise", record)
    answers()
    choose(panel.controls.axis, "m2")
    assert "m2 lacks an input" in panel.notices.toPlainText()
    assert panel.findings is None
    choose(panel.controls.axis, "m1")
    assert answers().question.axis == "m1"


def test_the_pair_can_be_chosen_and_the_unit_follows(panel, answers, record):
    panel.take_record("noise", record)
    assert answers().question.drive is Tap.CMD
    choose(panel.controls.drive, "u")
    assert answers().question.drive is Tap.U
    assert "[µm/V]" in shown_charts(panel)[0].title.text()
    choose(panel.controls.drive, "cmd")
    choose(panel.controls.answer, "u")
    assert answers().question.answer is Tap.U
    assert "[V/µm]" in shown_charts(panel)[0].title.text()
    choose(panel.controls.drive, "u")
    answers()
    assert "both u" in panel.notices.toPlainText()


def test_the_window_stays_alive_while_a_record_is_worked_on(
    qtbot, bench_window, panel, answers, record, held_up
):
    release, threads = held_up
    panel.take_record("slow", record)
    assert "computing" in panel.summary.text()
    qtbot.waitUntil(lambda: bool(threads), timeout=LONG_MS)
    for _ in range(3):
        with qtbot.waitSignal(bench_window.workbench.refreshed, timeout=LONG_MS):
            pass
    assert panel.findings is None
    release.set()
    answers()
    assert threading.main_thread() not in threads


def test_a_late_answer_is_dropped(qtbot, panel, answers, record, held_up):
    release, threads = held_up
    panel.take_record("first", record)
    qtbot.waitUntil(lambda: bool(threads), timeout=LONG_MS)
    first = panel._question
    choose(panel.controls.drive, "u")
    panel._receive(View.FREQUENCY, Findings(first, notices=("late: cmd",)))
    assert panel.findings is None
    release.set()
    answers()
    assert panel.notices.toPlainText() == "late: u"
    assert len(threads) == 2


def test_an_answer_to_another_view_is_not_drawn_over_the_one_in_sight(
    qtbot, bench_window, panel, answers, record, held_up
):
    release, threads = held_up
    model, frequency = (panel.controls.view.findData(v) for v in (View.MODEL, View.FREQUENCY))
    panel.controls.view.setCurrentIndex(model)
    panel.take_record("noise", record)
    known = answers()
    panel.controls.view.setCurrentIndex(frequency)
    qtbot.waitUntil(lambda: bool(threads), timeout=LONG_MS)
    panel.controls.view.setCurrentIndex(model)
    release.set()
    qtbot.waitUntil(lambda: not bench_window.workbench.busy, timeout=LONG_MS)
    assert panel.findings is known
    assert panel.notices.isHidden()
    panel.controls.view.setCurrentIndex(frequency)
    assert panel.notices.toPlainText() == "late: cmd"


def test_results_are_copied_and_saved(qtbot, panel, answers, record, tmp_path):
    panel.take_record("noise, wide", record)
    answers()
    panel.controls.copy.click()
    text = QGuiApplication.clipboard().text()
    assert text.startswith("identification: Frequency response\nrecord: noise, wide\n")
    assert "resonance" in text
    path = tmp_path / "results.csv"
    panel.save_text(path, as_csv(panel.findings, panel.controls.shown))
    qtbot.waitUntil(path.exists, timeout=LONG_MS)
    lines = path.read_text("utf-8").splitlines()
    assert "# pair: m1.cmd to m1.meas" in lines
    table = list(csv.reader(line for line in lines if not line.startswith("#")))
    assert table[0][:2] == ["frequency [Hz]", "magnitude [1]"]
    assert len(table) - 1 == len(panel.findings.columns[0].values)
    np.testing.assert_array_equal(
        [float(row[1]) for row in table[1:]], panel.findings.columns[1].values
    )


def test_results_that_cannot_be_written_are_a_notice(qtbot, bench_window, panel, tmp_path):
    panel.save_text(tmp_path / "missing" / "results.csv", "text")
    qtbot.waitUntil(lambda: bool(bench_window.notices.notices()), timeout=LONG_MS)
    assert "cannot be written" in bench_window.notices.notices()[0].text


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_themes_reach_every_part(bench_window, panel, answers, record, theme):
    panel.take_record("noise", record)
    answers()
    bench_window.use_theme(theme)
    colours = bench_window.workbench.theme
    assert colours.real in panel.charts[0].title.text()
    assert colours.warning in panel.notices.styleSheet()


@pytest.mark.every_panel
def test_the_page_fits_into_a_window_of_1280_by_800(bench_window, panel, answers, record):
    bench_window.resize(1280, 800)
    panel.take_record("noise", record)
    for view in View:
        panel.controls.view.setCurrentIndex(panel.controls.view.findData(view))
        answers()
        assert panel.minimumSizeHint().width() <= 720  # beside the control panel
        assert (bench_window.width(), bench_window.height()) == (1280, 800)


# --- excite -----------------------------------------------------------------------------------


@pytest.fixture
def exciting(qtbot, make_robot_window):
    """The page on the simulated RoTeMiNa, with its excitation in sight and a short motion ready."""
    window = make_robot_window()
    panel = window.panels["identification"]
    window.bring_up("identification")
    panel.controls.excite.setChecked(True)
    qtbot.waitUntil(lambda: panel.excite.motion is not None, timeout=LONG_MS)
    return panel


def set_up(qtbot, excite, wave, axis="zn", amplitude="", frequency="", time=""):
    excite.axis.setCurrentIndex(excite.axis.findData(axis))
    excite.amplitude.setText(amplitude)
    excite.frequency.setText(frequency)
    excite.time.setText(time)
    choose(excite.wave, wave)
    qtbot.waitUntil(lambda: excite.told.text() != CHECKING, timeout=LONG_MS)


def test_what_may_not_be_played_says_why(qtbot, exciting):
    excite, workbench = exciting.excite, exciting.workbench
    assert workbench.plan is None  # nothing is in hand before Play
    qtbot.waitUntil(excite.play.isEnabled, timeout=LONG_MS)
    assert excite.owner.text() == "X: free"
    set_up(qtbot, excite, Wave.SINE, amplitude="5", time="2")
    assert "has no unit" in excite.told.text()
    excite.refresh(workbench.session.snapshot())
    assert why_not(excite.play) == "the motion is not ready"
    excite.time.editingFinished.emit()
    assert excite.time.text() == "2 s"  # a bare number gets its unit
    set_up(qtbot, excite, Wave.STAIRCASE)
    assert not excite.frequency.isEnabled()
    workbench.emergency_stop()
    excite.refresh(workbench.session.snapshot())
    assert "release it first" in why_not(excite.play)
    assert why_not(excite.stop) == "the motion is not playing"
    assert excite.minimumSizeHint().width() <= EXCITE_WIDTH
    assert exciting.minimumSizeHint().width() <= 720  # beside the control panel


def test_a_speed_that_nothing_limits_is_asked_for_before_an_excitation(
    qtbot, make_robot_window, tmp_path
):
    robot = load_robot("rotemina")
    zn = replace(robot.axes["zn"], max_speed=None)
    write_robot(replace(robot, axes={**robot.axes, "zn": zn}), tmp_path / "unlimited.toml")
    window = make_robot_window(tmp_path / "unlimited.toml")
    panel = window.panels["identification"]
    window.bring_up("identification")
    panel.controls.excite.setChecked(True)
    qtbot.waitUntil(lambda: panel.excite.motion is not None, timeout=LONG_MS)
    set_up(qtbot, panel.excite, Wave.TRIANGLE, amplitude="5um", time="2 s")
    qtbot.waitUntil(panel.excite.play.isEnabled, timeout=LONG_MS)
    panel.excite.play.click()
    qtbot.waitUntil(lambda: bool(window.findChildren(SpeedLimitDialog)), timeout=LONG_MS)
    (dialog,) = window.findChildren(SpeedLimitDialog)
    playback = panel.workbench.playback
    assert playback.state.phase is PlaybackPhase.IDLE
    dialog.fields["zn"].setText("500")  # µm/s
    dialog.play.click()
    qtbot.waitUntil(lambda: playback.state.phase is PlaybackPhase.PLAYING, timeout=LONG_MS)
    panel.workbench.session.stop()


@pytest.mark.slow
def test_an_axis_is_excited_and_looked_at_beside_its_model(qtbot, exciting, answers_of):
    excite, workbench = exciting.excite, exciting.workbench
    workbench.session.service.set_effects(
        [AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.1})]
    )
    set_up(qtbot, excite, Wave.MULTISINE, frequency="100 Hz")
    qtbot.waitUntil(excite.play.isEnabled, timeout=LONG_MS)
    with qtbot.waitSignal(workbench.run_changed, timeout=2 * LONG_MS):
        excite.play.click()
        qtbot.waitUntil(lambda: excite.progress.value() > 0, timeout=LONG_MS)
        assert excite.owner.text() == "Z nano: controlled by playback"
        assert excite.stop.isEnabled()
    found = answers_of(exciting)
    assert exciting.controls.shown is View.FREQUENCY
    assert dict(found.rows)["estimator"] == "multisine"
    assert figure(exciting, "gain, lowest line") == pytest.approx(1.1, rel=1e-3)
    assert figure(exciting, "median coherence") > 0.99
    assert [each.name for each in found.pictures[0].curves][2:] == ["model", "measured"]
    assert exciting.isVisible()  # the comparison does not raise itself

    set_up(qtbot, excite, Wave.TRIANGLE, amplitude="5um", time="2 s")
    qtbot.waitUntil(excite.play.isEnabled, timeout=LONG_MS)
    before = workbench.run
    with qtbot.waitSignal(workbench.run_changed, timeout=2 * LONG_MS):
        excite.play.click()
        qtbot.waitUntil(lambda: excite.progress.value() > 300, timeout=LONG_MS)
        excite.stop.click()
    assert workbench.run is not before
    assert not workbench.run.completed
    assert answers_of(exciting).question.name == "Triangle of Z nano"
    assert exciting.controls.shown is View.LOOP


@pytest.mark.slow
def test_a_health_card_is_kept_and_compared_with(qtbot, panel, answers, record):
    panel.take_record("monday.csv", record)
    panel.controls.view.setCurrentText(View.HEALTH)
    first = answers()
    assert [row[0] for row in first.rows][:2] == ["gain", "resonance"]
    assert "no card of this axis" in first.notices[0]
    panel.controls.keep.click()
    qtbot.waitUntil(
        lambda: panel.findings is not None and "Last card" in panel.findings.notices[0],
        timeout=LONG_MS,
    )
    assert "No figure has changed" in panel.findings.notices[0]
