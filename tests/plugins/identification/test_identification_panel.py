"""The identification page: choices, results, background work and excitation."""

import csv
import threading
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QGuiApplication

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.app.widgets.controls import get_disabled_reason
from rotemina.plugins.identification.excitation import ExcitationWave
from rotemina.plugins.identification.excite_view import CHECKING
from rotemina.plugins.identification.export import to_csv
from rotemina.plugins.identification.findings import AnalysisFindings
from rotemina.plugins.identification.panel import ANALYSES
from rotemina.plugins.identification.record_query import AnalysisView
from rotemina.plugins.trajectory.speed_limit_dialog import SpeedLimitDialog
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap, write_record
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot, write_robot

LONG_MS = 30_000
RATE_HZ = 12_800.0


@pytest.fixture(scope="module")
def record():
    """Return a record of the mirror: noise on m1 (1000 Hz, damping ratio 0.02), m2 at zero."""
    time_s = np.arange(8192) / RATE_HZ
    command = 1e-6 * np.random.default_rng(3).uniform(-1.0, 1.0, 8192)
    signals = {("m1", Tap.CMD): command, ("m2", Tap.CMD): np.zeros(8192)}
    units = {"m1": "m", "m2": "m"}
    response = simulate_nominal_response(
        load_robot("fsm"), Record.from_signals(time_s, signals, units)
    ).signals
    signals[("m1", Tap.U)] = response["m1", Tap.U]
    signals[("m1", Tap.MEAS)] = response["m1", Tap.MEAS]
    return Record.from_signals(time_s, signals, units)


@pytest.fixture
def mirror_window(make_robot_window):
    return make_robot_window("fsm")


@pytest.fixture
def panel(mirror_window):
    return mirror_window.panels["identification"]


@pytest.fixture
def wait_for_findings(qtbot):
    """Return a function that waits until a panel shows findings, and returns them."""

    def wait(panel):
        qtbot.waitUntil(lambda: panel.findings is not None, timeout=LONG_MS)
        return panel.findings

    return wait


@pytest.fixture
def wait_for_panel_findings(panel, wait_for_findings):
    """Return a function that waits until the panel shows findings, and returns them."""
    return lambda: wait_for_findings(panel)


@pytest.fixture
def blocked_analysis(monkeypatch):
    """Block the frequency analysis until an event is set; yield the event and the threads used."""
    release, threads = threading.Event(), []

    def analyse(question):
        threads.append(threading.current_thread())
        release.wait(20.0)
        return AnalysisFindings(question, notices=(f"late: {question.input_tap}",))

    monkeypatch.setitem(ANALYSES, AnalysisView.FREQUENCY, analyse)
    yield release, threads
    release.set()


def select(choice, data):
    index = choice.findData(data)
    assert index >= 0
    choice.setCurrentIndex(index)
    choice.activated.emit(index)


def read_figure(panel, name):
    for row in range(panel.sheet.rowCount()):
        if panel.sheet.item(row, 0).text() == name:
            return float(panel.sheet.item(row, 1).text().split()[0])
    raise AssertionError(f"{name} is not shown")


def list_visible_charts(panel):
    return [chart for chart in panel.charts if not chart.isHidden()]


def test_every_view_shows_the_properties_of_the_robot(
    mirror_window, panel, wait_for_panel_findings, record
):
    assert "open a record" in panel.summary.text()
    assert not panel.controls.copy.isEnabled()
    assert not panel.controls.save.isEnabled()
    assert list_visible_charts(panel) == []
    panel.take_record("noise", record)
    wait_for_panel_findings()
    assert read_figure(panel, "resonance") == pytest.approx(1000.0, rel=2e-3)
    assert len(list_visible_charts(panel)) == 3
    for theme in ("light", "dark"):
        mirror_window.use_theme(theme)
        colours = mirror_window.workbench.theme
        assert colours.real in panel.charts[0].title.text()
        assert colours.warning in panel.notices.styleSheet()
    panel.controls.view.setCurrentIndex(panel.controls.view.findData(AnalysisView.MODEL))
    wait_for_panel_findings()
    assert read_figure(panel, "natural frequency") == pytest.approx(1000.0, rel=1e-4)
    assert read_figure(panel, "damping ratio") == pytest.approx(0.02, rel=1e-3)
    assert read_figure(panel, "fit") > 99.9
    assert panel.notices.isHidden()
    panel.controls.view.setCurrentIndex(panel.controls.view.findData(AnalysisView.STEPS))
    wait_for_panel_findings()
    assert "holds no jump" in panel.notices.toPlainText()
    assert not panel.notices.isHidden()


def test_a_record_opened_for_comparison_is_analysed_too(
    qtbot, mirror_window, panel, wait_for_panel_findings, record, tmp_path
):
    path = tmp_path / "noise.csv"
    write_record(record, path)
    with qtbot.waitSignal(mirror_window.workbench.run_changed, timeout=LONG_MS):
        mirror_window.workbench.records.open_record(path)
    assert wait_for_panel_findings().question.record is mirror_window.workbench.run.record
    assert "noise.csv" in panel.summary.text()


def test_the_page_opens_records_that_cannot_be_compared_and_names_unreadable_ones(
    qtbot, make_robot_window, wait_for_findings, tmp_path
):
    panel = make_robot_window("emps").panels["identification"]
    path = tmp_path / "spoilt.csv"
    path.write_text("t [s], q.cmd [um], q.meas [um]\n0, 1, 2\n1, x, 3\n", "utf-8")
    panel.open_record(path)
    qtbot.waitUntil(lambda: not panel.notices.isHidden(), timeout=LONG_MS)
    assert "spoilt.csv:3" in panel.notices.toPlainText()
    rng, time_s = np.random.default_rng(1), np.arange(2000) / 1000.0
    command = 0.1 + 1e-3 * rng.standard_normal(2000)
    signals = {("q", Tap.CMD): command, ("q", Tap.MEAS): command + 1e-5 * rng.standard_normal(2000)}
    path = tmp_path / "no voltage.csv"
    write_record(Record.from_signals(time_s, signals, {"q": "m"}), path)
    panel.open_record(path)
    wait_for_findings(panel)
    notices = panel.notices.toPlainText()
    assert "The nominal model is not shown: axis 'q' is moved by a force" in notices
    assert read_figure(panel, "gain, lowest line") == pytest.approx(1.0, abs=0.05)


def test_the_unit_follows_the_chosen_signals_and_missing_ones_are_named(
    panel, wait_for_panel_findings, record
):
    panel.take_record("noise", record)
    assert wait_for_panel_findings().question.input_tap is Tap.CMD
    select(panel.controls.drive, "u")
    assert wait_for_panel_findings().question.input_tap is Tap.U
    assert "[µm/V]" in list_visible_charts(panel)[0].title.text()
    select(panel.controls.drive, "cmd")
    select(panel.controls.answer, "u")
    assert wait_for_panel_findings().question.output_tap is Tap.U
    assert "[V/µm]" in list_visible_charts(panel)[0].title.text()
    select(panel.controls.drive, "u")
    wait_for_panel_findings()
    assert "both u" in panel.notices.toPlainText()
    select(panel.controls.axis, "m2")
    assert "m2 lacks an input" in panel.notices.toPlainText()
    assert panel.findings is None
    select(panel.controls.axis, "m1")
    assert wait_for_panel_findings().question.axis == "m1"


def test_the_window_stays_alive_during_an_analysis_and_late_findings_are_dropped(
    qtbot, mirror_window, panel, wait_for_panel_findings, record, blocked_analysis
):
    release, threads = blocked_analysis
    panel.take_record("slow", record)
    assert "computing" in panel.summary.text()
    qtbot.waitUntil(lambda: bool(threads), timeout=LONG_MS)
    for _ in range(3):
        with qtbot.waitSignal(mirror_window.workbench.refreshed, timeout=LONG_MS):
            pass
    first_question = panel._question
    select(panel.controls.drive, "u")
    panel._on_findings(
        AnalysisView.FREQUENCY, AnalysisFindings(first_question, notices=("late: cmd",))
    )
    assert panel.findings is None
    release.set()
    wait_for_panel_findings()
    assert panel.notices.toPlainText() == "late: u"
    assert len(threads) == 2
    assert threading.main_thread() not in threads


def test_findings_of_another_view_are_not_shown_in_the_current_one(
    qtbot, mirror_window, panel, wait_for_panel_findings, record, blocked_analysis
):
    release, threads = blocked_analysis
    model, frequency = (
        panel.controls.view.findData(view) for view in (AnalysisView.MODEL, AnalysisView.FREQUENCY)
    )
    panel.controls.view.setCurrentIndex(model)
    panel.take_record("noise", record)
    first_findings = wait_for_panel_findings()
    panel.controls.view.setCurrentIndex(frequency)
    qtbot.waitUntil(lambda: bool(threads), timeout=LONG_MS)
    panel.controls.view.setCurrentIndex(model)
    release.set()
    qtbot.waitUntil(lambda: not mirror_window.workbench.busy, timeout=LONG_MS)
    assert panel.findings is first_findings
    assert panel.notices.isHidden()
    panel.controls.view.setCurrentIndex(frequency)
    assert panel.notices.toPlainText() == "late: cmd"


def test_results_are_copied_and_saved_and_a_failed_save_becomes_a_notice(
    qtbot, mirror_window, panel, wait_for_panel_findings, record, tmp_path
):
    panel.take_record("noise, wide", record)
    wait_for_panel_findings()
    panel.controls.copy.click()
    text = QGuiApplication.clipboard().text()
    assert text.startswith("identification: Frequency response\nrecord: noise, wide\n")
    assert "resonance" in text
    path = tmp_path / "results.csv"
    panel.save_text(path, to_csv(panel.findings, panel.controls.current_view))
    qtbot.waitUntil(path.exists, timeout=LONG_MS)
    lines = path.read_text("utf-8").splitlines()
    assert "# pair: m1.cmd to m1.meas" in lines
    table = list(csv.reader(line for line in lines if not line.startswith("#")))
    assert table[0][:2] == ["frequency [Hz]", "magnitude [1]"]
    assert len(table) - 1 == len(panel.findings.columns[0].values)
    np.testing.assert_array_equal(
        [float(row[1]) for row in table[1:]], panel.findings.columns[1].values
    )
    panel.save_text(tmp_path / "missing" / "results.csv", "text")
    qtbot.waitUntil(
        lambda: "cannot be written" in mirror_window.notices.notices()[0].text, timeout=LONG_MS
    )


@pytest.fixture
def excite_panel(qtbot, make_robot_window):
    """Return the page for RoTeMiNa, with its excitation section open and a motion ready."""
    window = make_robot_window()
    panel = window.panels["identification"]
    window.bring_up("identification")
    panel.controls.excite.setChecked(True)
    qtbot.waitUntil(lambda: panel.excite.motion is not None, timeout=LONG_MS)
    return panel


def set_excitation(qtbot, excite, wave, axis="zn", amplitude="", frequency="", time=""):
    excite.axis.setCurrentIndex(excite.axis.findData(axis))
    excite.amplitude.setText(amplitude)
    excite.frequency.setText(frequency)
    excite.time.setText(time)
    select(excite.wave, wave)
    qtbot.waitUntil(lambda: excite.report.text() != CHECKING, timeout=LONG_MS)


def test_an_excitation_that_cannot_be_played_has_a_reason(qtbot, excite_panel):
    excite, workbench = excite_panel.excite, excite_panel.workbench
    assert workbench.plan is None  # nothing is loaded before Play
    qtbot.waitUntil(excite.play.isEnabled, timeout=LONG_MS)
    assert excite.owner.text() == "X: free"
    set_excitation(qtbot, excite, ExcitationWave.SINE, amplitude="5", time="2")
    assert "has no unit" in excite.report.text()
    excite.refresh(workbench.session.snapshot())
    assert get_disabled_reason(excite.play) == "the motion is not ready"
    excite.time.editingFinished.emit()
    assert excite.time.text() == "2 s"  # a bare number gets its unit
    set_excitation(qtbot, excite, ExcitationWave.STAIRCASE)
    assert not excite.frequency.isEnabled()
    workbench.emergency_stop()
    excite.refresh(workbench.session.snapshot())
    assert "release it first" in get_disabled_reason(excite.play)
    assert get_disabled_reason(excite.stop) == "the motion is not playing"


def test_an_unlimited_axis_needs_a_speed_limit_before_an_excitation(
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
    set_excitation(qtbot, panel.excite, ExcitationWave.TRIANGLE, amplitude="5um", time="2 s")
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
def test_an_axis_is_excited_and_compared_with_its_model(qtbot, excite_panel, wait_for_findings):
    excite, workbench = excite_panel.excite, excite_panel.workbench
    workbench.session.service.set_effects(
        [AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.1})]
    )
    set_excitation(qtbot, excite, ExcitationWave.MULTISINE, frequency="100 Hz")
    qtbot.waitUntil(excite.play.isEnabled, timeout=LONG_MS)
    with qtbot.waitSignal(workbench.run_changed, timeout=2 * LONG_MS):
        excite.play.click()
        qtbot.waitUntil(lambda: excite.progress.value() > 0, timeout=LONG_MS)
        assert excite.owner.text() == "Z nano: controlled by playback"
        assert excite.stop.isEnabled()
    findings = wait_for_findings(excite_panel)
    assert excite_panel.controls.current_view is AnalysisView.FREQUENCY
    assert dict(findings.rows)["estimator"] == "multisine"
    assert read_figure(excite_panel, "gain, lowest line") == pytest.approx(1.1, rel=1e-3)
    assert read_figure(excite_panel, "median coherence") > 0.99
    assert [curve.name for curve in findings.pictures[0].curves][2:] == ["model", "measured"]
    assert excite_panel.isVisible()  # the comparison does not raise itself

    set_excitation(qtbot, excite, ExcitationWave.TRIANGLE, amplitude="5um", time="2 s")
    qtbot.waitUntil(excite.play.isEnabled, timeout=LONG_MS)
    first_run = workbench.run
    with qtbot.waitSignal(workbench.run_changed, timeout=2 * LONG_MS):
        excite.play.click()
        qtbot.waitUntil(lambda: excite.progress.value() > 300, timeout=LONG_MS)
        excite.stop.click()
    assert workbench.run is not first_run
    assert not workbench.run.completed
    assert wait_for_findings(excite_panel).question.name == "Triangle of Z nano"
    assert excite_panel.controls.current_view is AnalysisView.LOOP


@pytest.mark.slow
def test_a_health_card_is_stored_and_compared(qtbot, panel, wait_for_panel_findings, record):
    panel.take_record("monday.csv", record)
    panel.controls.view.setCurrentText(AnalysisView.HEALTH)
    first_findings = wait_for_panel_findings()
    assert [row[0] for row in first_findings.rows][:2] == ["gain", "resonance"]
    assert "no card of this axis" in first_findings.notices[0]
    panel.controls.keep.click()
    qtbot.waitUntil(
        lambda: panel.findings is not None and "Last card" in panel.findings.notices[0],
        timeout=LONG_MS,
    )
    assert "No figure has changed" in panel.findings.notices[0]
