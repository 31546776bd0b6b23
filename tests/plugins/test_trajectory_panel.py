"""The trajectory panel: playing by hand, and the bounds beyond which it stops."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.trajectory.dry_run_table import BOUND, bound_text, read_bound
from rotemina.plugins.trajectory.speed_limit_dialog import SpeedLimitDialog
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.robot.writing import write_robot

PANELS = ("comparison",)

LONG_MS = 30_000


def swing(seconds=3.0, height=20e-6):
    time_s = np.arange(round(seconds * 500) + 1) / 500
    path = 30e-6 + height * np.sin(np.pi * time_s / time_s[-1]) ** 4
    return Record.from_signals(time_s, {("zn", Tap.CMD): path}, {"zn": "m"})


@pytest.fixture
def panel(qtbot, window):
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.workbench.plan_trajectory("swing", swing())
    panel = window.panels["trajectory"]
    qtbot.waitUntil(panel.transport.play.isEnabled, timeout=LONG_MS)
    return panel


def phase(panel):
    return panel.workbench.playback.state.phase


def click(qtbot, button):
    qtbot.waitUntil(button.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def at_rest(panel):
    return panel.workbench.session.snapshot().activity is DeviceState.IDLE


def notices(window):
    return [notice.text for notice in window.notices.notices()]


def test_played_paused_stepped_and_gone_on_with(qtbot, window, panel):
    bench, transport = window.workbench, panel.transport
    click(qtbot, transport.play)
    qtbot.waitUntil(lambda: bench.playback.state.row > 200, timeout=LONG_MS)
    click(qtbot, transport.play)
    qtbot.waitUntil(lambda: phase(panel) is PlaybackPhase.PAUSED and at_rest(panel))
    qtbot.waitUntil(lambda: transport.play.text() == "Resume", timeout=LONG_MS)
    row = bench.playback.state.row
    assert f"paused, row {row + 1} of 1501" in transport.progress.format()
    assert bench.run is None  # compared when it has ended, not in between
    click(qtbot, transport.forward)
    assert bench.playback.state.row == row + 1
    there = pytest.approx(swing().values[row + 1, 0], abs=1e-12)
    session = bench.session
    qtbot.waitUntil(lambda: session.snapshot().command["zn"] == there, timeout=LONG_MS)
    qtbot.waitUntil(lambda: at_rest(panel), timeout=LONG_MS)
    transport.speed.setValue(2.0)
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        click(qtbot, transport.play)
    assert phase(panel) is PlaybackPhase.IDLE
    assert len(list(bench.played_folder.glob("*_swing.csv.gz"))) == 2
    assert "Distance between model and machine: Z nano" in panel.gaps.text()
    assert notices(window) == []
    # Each stretch has its gap in the library.
    qtbot.waitUntil(
        lambda: [one.gap is None for one in bench.library.entries] == [False] * 2, timeout=LONG_MS
    )


def test_a_playback_that_ends_from_a_pause_is_compared_and_has_its_gap(qtbot, window, panel):
    bench, transport = window.workbench, panel.transport
    click(qtbot, transport.play)
    qtbot.waitUntil(lambda: bench.playback.state.row > 200, timeout=LONG_MS)
    click(qtbot, transport.play)
    qtbot.waitUntil(
        lambda: [bool(one.gap) for one in bench.library.entries] == [True], timeout=LONG_MS
    )
    assert bench.run is None
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        click(qtbot, transport.end)
    assert bench.run.record is bench.record
    assert not bench.run.completed
    assert phase(panel) is PlaybackPhase.IDLE
    assert notices(window) == []


def test_a_step_from_the_beginning_goes_to_the_first_row(qtbot, window, panel):
    click(qtbot, panel.transport.forward)
    assert window.workbench.playback.state.row == 0
    session = window.workbench.session
    qtbot.waitUntil(lambda: session.snapshot().command["zn"] == 30e-6, timeout=LONG_MS)
    click(qtbot, panel.transport.end)
    assert phase(panel) is PlaybackPhase.IDLE


def test_excess_pauses_and_says_so(qtbot, window, panel):
    session = window.workbench.session
    session.service.set_effects(
        (AxisEffect(axis="zn", id="gain_error", parameters={"error": 0.2}),)
    )
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)  # the plant is exchanged
    panel.table.item(0, BOUND).setText("8")
    assert window.workbench.bounds == {"zn": pytest.approx(8e-6)}
    click(qtbot, panel.transport.play)
    qtbot.waitUntil(lambda: len(notices(window)) > 0, timeout=LONG_MS)
    assert "Playback paused: axis Z nano deviates" in notices(window)[0]
    assert "the bound is 8 µm" in notices(window)[0]
    qtbot.waitUntil(lambda: phase(panel) is PlaybackPhase.PAUSED, timeout=LONG_MS)


def test_a_bound_may_be_changed_or_taken_away(window, panel):
    item = panel.table.item(0, BOUND)
    assert window.workbench.bounds == {"zn": pytest.approx(5e-6)}  # a quarter of the stroke
    item.setText("2,5 µm")
    assert "decimal" in notices(window)[0]
    assert item.text() == "5 µm"
    item.setText("")
    assert window.workbench.bounds == {}


def test_it_is_repeated_and_begun_anywhere(qtbot, window, panel):
    bench = window.workbench
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        panel.times.setValue(3)
    assert bench.plan.dry_run.duration_s == pytest.approx(9.0)
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        panel.begin.setValue(1.0)
    assert bench.plan.name == "swing, from 1 s, 3 ×"
    assert bench.plan.dry_run.duration_s == pytest.approx(8.0)
    ramp = Record.from_signals(
        [0.0, 1.0, 2.0], {("x", Tap.CMD): [0.0275, 0.0275, 0.0276]}, {"x": "m"}
    )
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("ramp", ramp)
    assert (panel.begin.value(), panel.begin.maximum(), panel.times.value()) == (0.0, 1.0, 1)
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        panel.times.setValue(2)
    assert "ends 100 µm from where it begins" in notices(window)[-1]
    assert (bench.plan.name, panel.times.value()) == ("ramp", 1)


def test_another_trajectory_ends_a_pause(qtbot, window, panel):
    click(qtbot, panel.transport.forward)
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.workbench.plan_trajectory("other", swing(1.0))
    assert phase(panel) is PlaybackPhase.IDLE


@pytest.mark.parametrize("text", ["0", "-1", "1_0", "five", "1 mm"])
def test_what_is_no_bound_is_refused(text):
    with pytest.raises(InputError, match="is not a bound"):
        read_bound(text, "m")


def test_a_bound_is_read_as_it_was_written():
    assert read_bound(bound_text(12.5e-6, "rad"), "rad") == pytest.approx(12.5e-6)
    assert read_bound("", "m") is None


def test_a_floor_taught_later_refuses_the_plan_before_it_is_played(qtbot, window, panel):
    session, transport = window.workbench.session, panel.transport
    assert "and of the tip" in panel.verdict.text()
    transport.speed.setValue(0.5)
    panel.table.item(0, BOUND).setText("8")
    session.go_to({"zn": 60e-6})
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)
    session.bounds.teach_floor()
    said = panel.verdict.text
    qtbot.waitUntil(lambda: "Not playable from here: tip:" in said(), timeout=LONG_MS)
    qtbot.waitUntil(lambda: "its floor is" in transport.play.toolTip(), timeout=LONG_MS)
    assert not transport.play.isEnabled()
    assert panel.path._out.any()
    with pytest.raises(InputError) as refused:
        session.play(swing())
    assert str(refused.value) in panel.verdict.text()
    panel.path.whole = True
    assert not panel.path.grab().isNull()
    session.bounds.clear_floor()
    qtbot.waitUntil(transport.play.isEnabled, timeout=LONG_MS)
    assert not panel.path._out.any()
    assert transport.speed.value() == 0.5  # what the operator set stays with the trajectory
    assert window.workbench.bounds == {"zn": pytest.approx(8e-6)}
    assert notices(window) == []


def test_points_are_taken_typed_and_made_a_trajectory_of(qtbot, window, panel):
    session, view = window.workbench.session, panel.points
    panel.teach.click()
    assert view.isVisibleTo(panel)
    assert not panel.tried.isVisibleTo(panel)
    click(qtbot, view.take)
    here = session.snapshot().command["zn"]
    session.go_to({"zn": 40e-6})
    qtbot.waitUntil(lambda: session.snapshot().command["zn"] == 40e-6, timeout=LONG_MS)
    click(qtbot, view.take)
    assert [point.place["zn"] for point in view.points] == [here, 40e-6]
    zn, speed, pause = 5, 6, 7
    for column, text, why in (
        (zn, "65.1", "must be 0.000 µm to 65.000 µm"),
        (speed, "0", "above 0 and at most 100 %"),
        (pause, "x", "must be 0 to 3600 s"),
    ):
        before = view.table.item(1, column).text()
        view.table.item(1, column).setText(text)
        assert why in notices(window)[0]
        assert view.table.item(1, column).text() == before
    view.table.item(1, zn).setText("45.5")
    view.table.item(1, pause).setText("0.2")
    assert view.points[1].place["zn"] == pytest.approx(45.5e-6)
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        click(qtbot, view.use)
    plan = window.workbench.plan
    assert plan.name == "2 taught points"
    assert plan.dry_run.allowed
    assert plan.trajectory.signal("zn", Tap.CMD)[[0, -1]] == pytest.approx([here, 45.5e-6])
    assert not view.isVisibleTo(panel)  # what the dry run found is shown
    panel.teach.click()
    view.table.selectRow(0)
    click(qtbot, view.remove)
    assert len(view.points) == 1


@pytest.fixture
def unlimited(qtbot, make_robot_window, tmp_path):
    """A window on a machine whose robot file limits the speed of no axis."""
    robot = load_robot("rotemina")
    zn = replace(robot.axes["zn"], max_speed=None)
    write_robot(replace(robot, axes={**robot.axes, "zn": zn}), tmp_path / "unlimited.toml")
    window = make_robot_window(tmp_path / "unlimited.toml")
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.workbench.plan_trajectory("swing", swing())
    qtbot.waitUntil(window.panels["trajectory"].transport.play.isEnabled, timeout=LONG_MS)
    return window


def speed_question(window):
    shown = [one for one in window.findChildren(SpeedLimitDialog) if one.isVisible()]
    return shown[0] if shown else None


def test_a_speed_that_nothing_limits_is_asked_for_once_and_kept(qtbot, unlimited):
    bench, panel = unlimited.workbench, unlimited.panels["trajectory"]
    assert "no limit is stated for the speed of Z nano" in panel.verdict.text()
    click(qtbot, panel.transport.play)
    dialog = speed_question(unlimited)
    assert phase(panel) is PlaybackPhase.IDLE
    assert "the trajectory reaches 54" in dialog.fields["zn"].placeholderText()
    for text in ("", "fast", "0", "-5"):
        dialog.fields["zn"].setText(text)
        assert not dialog.play.isEnabled()
    dialog.fields["zn"].setText("60")  # µm/s
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        click(qtbot, dialog.play)
    # It is remembered, and holds at a higher pace too.
    qtbot.waitUntil(lambda: panel.transport.play.text() == "Play", timeout=LONG_MS)
    panel.transport.speed.setValue(4.0)
    qtbot.waitUntil(lambda: panel.transport.play.text() == "Play", timeout=LONG_MS)
    click(qtbot, panel.transport.play)
    qtbot.waitUntil(lambda: bool(notices(unlimited)), timeout=LONG_MS)
    assert speed_question(unlimited) is None
    assert "beyond the limit 60 µm/s" in notices(unlimited)[-1]
    assert phase(panel) is PlaybackPhase.IDLE


def test_who_gives_no_speed_moves_nothing(qtbot, unlimited):
    panel = unlimited.panels["trajectory"]
    click(qtbot, panel.transport.play)
    click(qtbot, panel.transport.play)
    dialog = speed_question(unlimited)
    dialog.reject()
    assert speed_question(unlimited) is None
    assert phase(panel) is PlaybackPhase.IDLE
    click(qtbot, panel.transport.play)
    unlimited.workbench.session.stop()
    qtbot.waitUntil(lambda: speed_question(unlimited) is None, timeout=LONG_MS)


# --- an axis that was moved during a pause --------------------------------------------------------


@pytest.fixture
def moved_away(qtbot, window, panel):
    """Pause the swing, and move another axis, as a hand on its arrows would."""
    transport, session = panel.transport, window.workbench.session
    click(qtbot, transport.play)
    qtbot.waitUntil(lambda: window.workbench.playback.state.row > 200, timeout=LONG_MS)
    click(qtbot, transport.play)
    qtbot.waitUntil(lambda: phase(panel) is PlaybackPhase.PAUSED, timeout=LONG_MS)
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)
    session.jog("y", 0.5e-3)
    said = "Y moved 500 µm since the pause"
    line = f"{said}: Resume asks how to go on."
    qtbot.waitUntil(lambda: panel.gaps.text() == line, timeout=LONG_MS)
    header = f"{said}; Resume asks how to go on."
    qtbot.waitUntil(lambda: window._bar.doing.text() == header, timeout=LONG_MS)
    assert window._bar.phase.text().startswith("Paused at row ")
    assert window._bar.phase.property("tone") == "warning"
    assert not transport.forward.isEnabled()
    return session.snapshot().command["y"]


def ask_to_resume(qtbot, window, panel):
    """Press Resume, and return the question in which that ends."""
    click(qtbot, panel.transport.play)
    question = window.resume_question
    qtbot.waitUntil(question.isVisible, timeout=LONG_MS)
    assert question.text.text() == "Y moved 500 µm since the pause. How to go on?"
    assert not question.isModal()
    return question


def test_resume_asks_and_moves_back_slowly_before_it_goes_on(qtbot, window, panel, moved_away):
    bench, session = window.workbench, window.workbench.session
    question, row = ask_to_resume(qtbot, window, panel), bench.playback.state.row
    assert session.at_rest  # nothing moves until that is answered
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        click(qtbot, question.move_back)
        assert question.isHidden()
        back = f"Moving back slowly to row {row + 1}; then the playback resumes."
        qtbot.waitUntil(lambda: window._bar.doing.text() == back, timeout=LONG_MS)
        assert panel.transport.play.isEnabled() is False
    assert session.snapshot().command["y"] == pytest.approx(moved_away - 0.5e-3, abs=1e-9)
    assert bench.playback.state.row == 1500
    assert notices(window) == []


def test_resume_asks_and_starts_over(qtbot, window, panel, moved_away):
    bench = window.workbench
    question = ask_to_resume(qtbot, window, panel)
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        click(qtbot, question.start_over)
    assert bench.run.record.duration_s == pytest.approx(3.0, abs=0.01)
    assert bench.session.snapshot().command["y"] == pytest.approx(moved_away, abs=1e-9)


def test_a_question_is_withdrawn_by_a_stop_or_when_the_axis_comes_back(
    qtbot, window, panel, moved_away
):
    question = ask_to_resume(qtbot, window, panel)
    window.workbench.stop()
    qtbot.waitUntil(question.isHidden, timeout=LONG_MS)
    question = ask_to_resume(qtbot, window, panel)
    click(qtbot, question.keep)
    assert question.isHidden()
    question = ask_to_resume(qtbot, window, panel)
    window.workbench.jog("y", -0.5e-3)
    qtbot.waitUntil(question.isHidden, timeout=LONG_MS)
    assert phase(panel) is PlaybackPhase.PAUSED


def test_a_stop_on_the_way_back_keeps_the_pause_and_says_so(qtbot, window, panel, moved_away):
    question = ask_to_resume(qtbot, window, panel)
    click(qtbot, question.move_back)
    state = window.workbench.session.snapshot
    qtbot.waitUntil(lambda: state().activity is DeviceState.MOVING, timeout=LONG_MS)
    click(qtbot, window.stop_button)
    qtbot.waitUntil(lambda: bool(notices(window)), timeout=LONG_MS)
    assert notices(window) == ["Not resumed: the machine was stopped again."]
    assert phase(panel) is PlaybackPhase.PAUSED


def test_the_second_press_of_a_double_click_on_pause_does_not_resume(qtbot, window, panel):
    bench, play = window.workbench, panel.transport.play
    click(qtbot, play)
    qtbot.waitUntil(lambda: bench.playback.state.row > 200, timeout=LONG_MS)
    click(qtbot, play)
    qtbot.waitUntil(lambda: phase(panel) is PlaybackPhase.PAUSED, timeout=LONG_MS)
    bench.toggle_playback()  # the next press, before the button has been Resume for half a second
    assert "Not done: " in notices(window)[0]
    assert phase(panel) is PlaybackPhase.PAUSED
    qtbot.waitUntil(lambda: play.text() == "Resume" and play.isEnabled(), timeout=LONG_MS)
