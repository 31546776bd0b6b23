"""The trajectory panel: playback controls, bounds, taught points and resuming."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.trajectory.dry_run_table import BOUND_COLUMN, format_bound, parse_bound
from rotemina.plugins.trajectory.speed_limit_dialog import SpeedLimitDialog
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot, write_robot

PANELS = ("comparison",)

LONG_MS = 30_000


def make_swing(seconds=3.0, height=20e-6):
    time_s = np.arange(round(seconds * 500) + 1) / 500
    positions = 30e-6 + height * np.sin(np.pi * time_s / time_s[-1]) ** 4
    return Record.from_signals(time_s, {("zn", Tap.CMD): positions}, {"zn": "m"})


@pytest.fixture
def panel(qtbot, window):
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.workbench.plan_trajectory("swing", make_swing())
    panel = window.panels["trajectory"]
    qtbot.waitUntil(panel.transport.play.isEnabled, timeout=LONG_MS)
    return panel


def get_phase(panel):
    return panel.workbench.playback.state.phase


def click(qtbot, button):
    qtbot.waitUntil(button.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def is_at_rest(panel):
    return panel.workbench.session.snapshot().activity is DeviceState.IDLE


def list_notices(window):
    return [notice.text for notice in window.notices.notices()]


def test_a_playback_is_paused_stepped_and_resumed(qtbot, window, panel):
    workbench, transport = window.workbench, panel.transport
    click(qtbot, transport.play)
    qtbot.waitUntil(lambda: workbench.playback.state.row > 200, timeout=LONG_MS)
    click(qtbot, transport.play)
    qtbot.waitUntil(lambda: get_phase(panel) is PlaybackPhase.PAUSED and is_at_rest(panel))
    qtbot.waitUntil(lambda: transport.play.text() == "Resume", timeout=LONG_MS)
    row = workbench.playback.state.row
    assert f"paused, row {row + 1} of 1501" in transport.progress.format()
    assert workbench.run is None  # compared only after the end of the playback
    click(qtbot, transport.forward)
    assert workbench.playback.state.row == row + 1
    expected = pytest.approx(make_swing().values[row + 1, 0], abs=1e-12)
    session = workbench.session
    qtbot.waitUntil(lambda: session.snapshot().command["zn"] == expected, timeout=LONG_MS)
    qtbot.waitUntil(lambda: is_at_rest(panel), timeout=LONG_MS)
    transport.speed.setValue(2.0)
    with qtbot.waitSignal(workbench.run_changed, timeout=LONG_MS):
        click(qtbot, transport.play)
    assert get_phase(panel) is PlaybackPhase.IDLE
    assert len(list(workbench.played_folder.glob("*_swing.csv.gz"))) == 2
    assert "Distance between model and machine: Z nano" in panel.gaps.text()
    assert list_notices(window) == []
    # Both parts of the run have a gap in the library.
    qtbot.waitUntil(
        lambda: [entry.gap is None for entry in workbench.library.entries] == [False] * 2,
        timeout=LONG_MS,
    )


def test_a_double_click_on_pause_does_not_resume_and_the_end_is_compared(qtbot, window, panel):
    workbench, transport = window.workbench, panel.transport
    click(qtbot, transport.play)
    qtbot.waitUntil(lambda: workbench.playback.state.row > 200, timeout=LONG_MS)
    click(qtbot, transport.play)
    qtbot.waitUntil(lambda: get_phase(panel) is PlaybackPhase.PAUSED, timeout=LONG_MS)
    # The next press follows before the button has shown Resume for half a second.
    workbench.toggle_playback()
    assert "Not done: " in list_notices(window)[0]
    assert get_phase(panel) is PlaybackPhase.PAUSED
    qtbot.waitUntil(
        lambda: transport.play.text() == "Resume" and transport.play.isEnabled(), timeout=LONG_MS
    )
    qtbot.waitUntil(
        lambda: [bool(entry.gap) for entry in workbench.library.entries] == [True], timeout=LONG_MS
    )
    assert workbench.run is None
    with qtbot.waitSignal(workbench.run_changed, timeout=LONG_MS):
        click(qtbot, transport.end)
    assert workbench.run.record is workbench.record
    assert not workbench.run.completed
    assert get_phase(panel) is PlaybackPhase.IDLE
    assert len(list_notices(window)) == 1


def test_a_step_before_the_start_moves_to_the_first_row_and_another_trajectory_ends_the_pause(
    qtbot, window, panel
):
    session = window.workbench.session
    click(qtbot, panel.transport.forward)
    assert window.workbench.playback.state.row == 0
    qtbot.waitUntil(lambda: session.snapshot().command["zn"] == 30e-6, timeout=LONG_MS)
    click(qtbot, panel.transport.end)
    assert get_phase(panel) is PlaybackPhase.IDLE
    click(qtbot, panel.transport.forward)
    assert get_phase(panel) is PlaybackPhase.PAUSED
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.workbench.plan_trajectory("other", make_swing(1.0))
    assert get_phase(panel) is PlaybackPhase.IDLE


def test_a_deviation_beyond_the_bound_pauses_with_a_notice(qtbot, window, panel):
    session, item = window.workbench.session, panel.table.item(0, BOUND_COLUMN)
    assert window.workbench.bounds == {"zn": pytest.approx(5e-6)}  # a quarter of the stroke
    item.setText("2,5 µm")
    assert "decimal" in list_notices(window)[0]
    assert item.text() == "5 µm"
    item.setText("")
    assert window.workbench.bounds == {}
    session.service.set_effects(
        (AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.2}),)
    )
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)  # the new plant is in use
    item.setText("8")
    assert window.workbench.bounds == {"zn": pytest.approx(8e-6)}
    click(qtbot, panel.transport.play)
    qtbot.waitUntil(
        lambda: "Playback paused: axis Z nano deviates" in list_notices(window)[0], timeout=LONG_MS
    )
    assert "the bound is 8 µm" in list_notices(window)[0]
    qtbot.waitUntil(lambda: get_phase(panel) is PlaybackPhase.PAUSED, timeout=LONG_MS)


def test_a_trajectory_can_be_repeated_and_started_in_between(qtbot, window, panel):
    workbench = window.workbench
    with qtbot.waitSignal(workbench.plan_changed, timeout=LONG_MS):
        panel.passes_field.setValue(3)
    assert workbench.plan.dry_run.duration_s == pytest.approx(9.0)
    with qtbot.waitSignal(workbench.plan_changed, timeout=LONG_MS):
        panel.start_field.setValue(1.0)
    assert workbench.plan.name == "swing, from 1 s, 3 ×"
    assert workbench.plan.dry_run.duration_s == pytest.approx(8.0)
    ramp = Record.from_signals(
        [0.0, 1.0, 2.0], {("x", Tap.CMD): [0.0275, 0.0275, 0.0276]}, {"x": "m"}
    )
    with qtbot.waitSignal(workbench.plan_changed, timeout=LONG_MS):
        workbench.plan_trajectory("ramp", ramp)
    assert (panel.start_field.value(), panel.start_field.maximum(), panel.passes_field.value()) == (
        0.0,
        1.0,
        1,
    )
    with qtbot.waitSignal(workbench.plan_changed, timeout=LONG_MS):
        panel.passes_field.setValue(2)
    assert "ends 100 µm from where it begins" in list_notices(window)[-1]
    assert (workbench.plan.name, panel.passes_field.value()) == ("ramp", 1)


@pytest.mark.parametrize("text", ["0", "-1", "1_0", "five", "1 mm"])
def test_an_invalid_bound_is_refused(text):
    with pytest.raises(InputError, match="is not a bound"):
        parse_bound(text, "m")


def test_a_formatted_bound_is_parsed_again():
    assert parse_bound(format_bound(12.5e-6, "rad"), "rad") == pytest.approx(12.5e-6)
    assert parse_bound("", "m") is None


def test_a_floor_taught_later_makes_the_plan_unplayable(qtbot, window, panel):
    session, transport = window.workbench.session, panel.transport
    assert "and of the tip" in panel.verdict.text()
    transport.speed.setValue(0.5)
    panel.table.item(0, BOUND_COLUMN).setText("8")
    session.go_to({"zn": 60e-6})
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)
    session.bounds.teach_floor()
    read_verdict = panel.verdict.text
    qtbot.waitUntil(lambda: "Not playable from here: tip:" in read_verdict(), timeout=LONG_MS)
    qtbot.waitUntil(lambda: "its floor is" in transport.play.toolTip(), timeout=LONG_MS)
    assert not transport.play.isEnabled()
    assert panel.path._is_forbidden.any()
    with pytest.raises(InputError) as refused:
        session.play(make_swing())
    assert str(refused.value) in panel.verdict.text()
    panel.path.shows_reach = True
    assert not panel.path.grab().isNull()
    session.bounds.clear_floor()
    qtbot.waitUntil(transport.play.isEnabled, timeout=LONG_MS)
    assert not panel.path._is_forbidden.any()
    assert transport.speed.value() == 0.5  # the operator's settings are kept
    assert window.workbench.bounds == {"zn": pytest.approx(8e-6)}
    assert list_notices(window) == []


def test_points_are_taught_edited_and_made_into_a_trajectory(qtbot, window, panel):
    session, view = window.workbench.session, panel.points
    panel.teach.click()
    assert view.isVisibleTo(panel)
    assert not panel.dry_run_view.isVisibleTo(panel)
    click(qtbot, view.add_button)
    start = session.snapshot().command["zn"]
    session.go_to({"zn": 40e-6})
    qtbot.waitUntil(lambda: session.snapshot().command["zn"] == 40e-6, timeout=LONG_MS)
    click(qtbot, view.add_button)
    assert [point.place["zn"] for point in view.points] == [start, 40e-6]
    zn, speed, pause = 5, 6, 7
    for column, text, message in (
        (zn, "65.1", "must be 0.000 µm to 65.000 µm"),
        (speed, "0", "above 0 and at most 100 %"),
        (pause, "x", "must be 0 to 3600 s"),
    ):
        old_text = view.table.item(1, column).text()
        view.table.item(1, column).setText(text)
        assert message in list_notices(window)[0]
        assert view.table.item(1, column).text() == old_text
    view.table.item(1, zn).setText("45.5")
    view.table.item(1, pause).setText("0.2")
    assert view.points[1].place["zn"] == pytest.approx(45.5e-6)
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        click(qtbot, view.use_button)
    plan = window.workbench.plan
    assert plan.name == "2 taught points"
    assert plan.dry_run.allowed
    assert plan.trajectory.signal("zn", Tap.CMD)[[0, -1]] == pytest.approx([start, 45.5e-6])
    assert not view.isVisibleTo(panel)  # the dry run is shown instead
    panel.teach.click()
    view.table.selectRow(0)
    click(qtbot, view.remove_button)
    assert len(view.points) == 1


@pytest.fixture
def unlimited_window(qtbot, make_robot_window, tmp_path):
    """Return a window for a robot file without a speed limit of zn."""
    robot = load_robot("rotemina")
    zn = replace(robot.axes["zn"], max_speed=None)
    write_robot(replace(robot, axes={**robot.axes, "zn": zn}), tmp_path / "unlimited.toml")
    window = make_robot_window(tmp_path / "unlimited.toml")
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.workbench.plan_trajectory("swing", make_swing())
    qtbot.waitUntil(window.panels["trajectory"].transport.play.isEnabled, timeout=LONG_MS)
    return window


def find_speed_dialog(window):
    dialogs = [dialog for dialog in window.findChildren(SpeedLimitDialog) if dialog.isVisible()]
    return dialogs[0] if dialogs else None


def test_without_a_speed_limit_nothing_moves_and_a_typed_one_is_remembered(qtbot, unlimited_window):
    workbench, panel = unlimited_window.workbench, unlimited_window.panels["trajectory"]
    assert "no limit is stated for the speed of Z nano" in panel.verdict.text()
    click(qtbot, panel.transport.play)
    click(qtbot, panel.transport.play)
    find_speed_dialog(unlimited_window).reject()
    assert find_speed_dialog(unlimited_window) is None
    assert get_phase(panel) is PlaybackPhase.IDLE
    click(qtbot, panel.transport.play)
    workbench.session.stop()
    qtbot.waitUntil(lambda: find_speed_dialog(unlimited_window) is None, timeout=LONG_MS)

    click(qtbot, panel.transport.play)
    dialog = find_speed_dialog(unlimited_window)
    assert get_phase(panel) is PlaybackPhase.IDLE
    assert "the trajectory reaches 54" in dialog.fields["zn"].placeholderText()
    for text in ("", "fast", "0", "-5"):
        dialog.fields["zn"].setText(text)
        assert not dialog.play.isEnabled()
    dialog.fields["zn"].setText("60")  # µm/s
    with qtbot.waitSignal(workbench.run_changed, timeout=LONG_MS):
        click(qtbot, dialog.play)
    # The limit is remembered, and also applies to a faster playback.
    qtbot.waitUntil(lambda: panel.transport.play.text() == "Play", timeout=LONG_MS)
    panel.transport.speed.setValue(4.0)
    qtbot.waitUntil(lambda: panel.transport.play.text() == "Play", timeout=LONG_MS)
    click(qtbot, panel.transport.play)
    qtbot.waitUntil(lambda: bool(list_notices(unlimited_window)), timeout=LONG_MS)
    assert find_speed_dialog(unlimited_window) is None
    assert "beyond the limit 60 µm/s" in list_notices(unlimited_window)[-1]
    assert get_phase(panel) is PlaybackPhase.IDLE


@pytest.fixture
def moved_y_m(qtbot, window, panel):
    """Pause the swing and jog another axis; return the new position of that axis."""
    transport, session = panel.transport, window.workbench.session
    click(qtbot, transport.play)
    qtbot.waitUntil(lambda: window.workbench.playback.state.row > 200, timeout=LONG_MS)
    click(qtbot, transport.play)
    qtbot.waitUntil(lambda: get_phase(panel) is PlaybackPhase.PAUSED, timeout=LONG_MS)
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)
    session.jog("y", 0.5e-3)
    moved_text = "Y moved 500 µm since the pause"
    gaps_text = f"{moved_text}: Resume asks how to go on."
    qtbot.waitUntil(lambda: panel.gaps.text() == gaps_text, timeout=LONG_MS)
    status_text = f"{moved_text}; Resume asks how to continue."
    qtbot.waitUntil(lambda: window._bar.reason_label.text() == status_text, timeout=LONG_MS)
    assert window._bar.phase.text().startswith("Paused at row ")
    assert window._bar.phase.property("tone") == "warning"
    assert not transport.forward.isEnabled()
    return session.snapshot().command["y"]


def ask_to_resume(qtbot, window, panel):
    """Press Resume, and return the question that appears."""
    click(qtbot, panel.transport.play)
    question = window.resume_question
    qtbot.waitUntil(question.isVisible, timeout=LONG_MS)
    assert question.text.text() == "Y moved 500 µm since the pause. How do you want to continue?"
    assert not question.isModal()
    return question


def test_resume_asks_and_moves_back_slowly_before_the_playback(qtbot, window, panel, moved_y_m):
    workbench, session = window.workbench, window.workbench.session
    question, row = ask_to_resume(qtbot, window, panel), workbench.playback.state.row
    assert session.at_rest  # nothing moves before the answer
    with qtbot.waitSignal(workbench.run_changed, timeout=LONG_MS):
        click(qtbot, question.move_back)
        assert question.isHidden()
        status_text = f"Moving back slowly to row {row + 1}; then the playback resumes."
        qtbot.waitUntil(lambda: window._bar.reason_label.text() == status_text, timeout=LONG_MS)
        assert panel.transport.play.isEnabled() is False
    assert session.snapshot().command["y"] == pytest.approx(moved_y_m - 0.5e-3, abs=1e-9)
    assert workbench.playback.state.row == 1500
    assert list_notices(window) == []


def test_resume_asks_and_can_start_over(qtbot, window, panel, moved_y_m):
    workbench = window.workbench
    question = ask_to_resume(qtbot, window, panel)
    with qtbot.waitSignal(workbench.run_changed, timeout=LONG_MS):
        click(qtbot, question.start_over)
    assert workbench.run.record.duration_s == pytest.approx(3.0, abs=0.01)
    assert workbench.session.snapshot().command["y"] == pytest.approx(moved_y_m, abs=1e-9)


def test_a_stop_or_the_return_of_the_axis_cancels_the_question_and_keeps_the_pause(
    qtbot, window, panel, moved_y_m
):
    session, moved_text = window.workbench.session, panel.gaps.text()
    question = ask_to_resume(qtbot, window, panel)
    window.workbench.stop()
    qtbot.waitUntil(question.isHidden, timeout=LONG_MS)
    question = ask_to_resume(qtbot, window, panel)
    click(qtbot, question.keep)
    assert question.isHidden()
    question = ask_to_resume(qtbot, window, panel)
    window.workbench.jog("y", -0.5e-3)
    qtbot.waitUntil(question.isHidden, timeout=LONG_MS)
    assert get_phase(panel) is PlaybackPhase.PAUSED

    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)
    session.jog("y", 0.5e-3)
    qtbot.waitUntil(lambda: panel.gaps.text() == moved_text, timeout=LONG_MS)
    question = ask_to_resume(qtbot, window, panel)
    click(qtbot, question.move_back)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    click(qtbot, window.stop_button)
    qtbot.waitUntil(lambda: bool(list_notices(window)), timeout=LONG_MS)
    assert list_notices(window) == ["Not resumed: the machine was stopped again."]
    assert get_phase(panel) is PlaybackPhase.PAUSED
