"""The main window on the simulator, with its real threads."""

import threading
from importlib.metadata import EntryPoint
from operator import attrgetter

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import PlaybackFinished
from rotemina.app.settings import UserSettings
from rotemina.app.shell.panels import DeferredPanelLoader
from rotemina.app.shell.panels.panel_host import ENTRY_POINT_GROUP
from rotemina.app.shell.startup import window_run
from rotemina.app.shell.window import main_window as module
from rotemina.app.shell.window.layouts import TUNE
from rotemina.app.widgets.layout import find_frame
from rotemina.drivers.contract import DeviceState, registry
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap, read_record, write_record
from rotemina.sim.robot_files import load_robot

PANELS = ("comparison",)
LONG_MS = 30_000
BUILT_IN = [
    *("job", "events", "control", "plots", "trajectory", "microscope", "comparison", "connection"),
    *("teleoperation", "inputs", "identification", "calibration", "compensation", "penetration"),
    *("effects", "gap", "faults", "recorder", "view3d", "plate"),
]


def write_short_trajectory(path, seconds=0.4, height=2e-4):
    """Write a smooth move of thx and back."""
    time_s = np.arange(int(seconds * 500) + 1) / 500
    command = 5.81775e-4 + height * np.sin(np.pi * time_s / time_s[-1]) ** 2
    write_record(Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"}), path)
    return path


def get_notice_texts(window):
    return [notice.text for notice in window.notices.notices()]


def load(qtbot, window, path):
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.use_file_with_columns(path, window.workbench.planner.load_trajectory)


@pytest.fixture
def make_window_in_steps(make_robot_window, monkeypatch):
    """Make a window with all panels, none of which is made before the test asks for it."""
    monkeypatch.setattr(DeferredPanelLoader, "start", lambda _: None)
    monkeypatch.setattr(DeferredPanelLoader, "_make_all_before_work", lambda *_: None)
    return make_robot_window


@pytest.mark.every_panel
def test_all_panels_are_made_before_any_work(qtbot, window):
    with qtbot.waitSignal(window.workbench.jobs.busy_changed, timeout=LONG_MS):
        window.workbench.work("any", "Reading …", lambda: None, lambda _: None)
    # All panels are made before the work starts, so none misses its result.
    assert window.panels.pending_names == ()
    for name, dock in window.docks.items():
        assert dock.widget().widget() is window.panels[name]
    assert list(window.panels) == BUILT_IN
    assert get_notice_texts(window) == []
    hidden = {"microscope"}  # the second tab of the centre
    assert {
        name for name, panel in window.panels.items() if not panel.isVisibleTo(window)
    } == hidden


@pytest.mark.every_panel
def test_a_panel_is_made_and_laid_out_when_its_dock_becomes_visible(qtbot, make_window_in_steps):
    window = make_window_in_steps()
    for name in ("gap", "plate"):
        window.docks[name].raise_()
        assert name not in window.panels.made
        window.panel_loader.make_visible_panels()
        laid_out = [widget.geometry() for widget in window.findChildren(QWidget)]
        QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
        assert laid_out == [widget.geometry() for widget in window.findChildren(QWidget)]
    window.docks["faults"].raise_()
    qtbot.waitUntil(lambda: "faults" in window.panels.made, timeout=LONG_MS)
    assert window.panels.pending_names
    assert "view3d" not in window.panels.made
    window.bring_up("view3d")
    assert window.docks["view3d"].widget().widget() is window.panels.made["view3d"]


@pytest.mark.every_panel
def test_panels_are_made_in_small_steps_once_their_libraries_are_loaded(
    qtbot, make_window_in_steps
):
    window, libraries_loaded = make_window_in_steps(), threading.Event()
    loader, panels = window.panel_loader, window.panels
    loader._since.start()
    window.arrangement.arrange(TUNE)
    shown_names = ("connection", "identification")
    assert not panels.made.keys() & set(shown_names)
    for _ in range(100):
        made_before = len(panels.made)
        placed_before = sum(dock.widget() is not None for dock in window.docks.values())
        loader.make_visible_panels()
        steps = len(panels.made) - made_before
        steps += sum(dock.widget() is not None for dock in window.docks.values()) - placed_before
        assert steps <= 1
    for name in shown_names:
        assert window.docks[name].widget() is find_frame(panels.made[name])
    thread = threading.Thread(target=libraries_loaded.wait)

    def start_loading():
        thread.start()
        return thread

    pending = panels.pending_names
    loader.start_loading = start_loading
    for _ in range(3):
        loader._make_next()
    assert thread.is_alive()
    assert panels.pending_names == pending != ()
    libraries_loaded.set()
    thread.join()
    with qtbot.waitSignal(loader.done, timeout=LONG_MS):
        loader._next.start()
    assert panels.pending_names == ()


def start_moving(qtbot, window):
    session = window.workbench.session
    session.go_to({"x": 0.05})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    return session


def test_stops_stay_in_a_small_window_and_escape_stops(qtbot, window, press_escape):
    window.resize(640, 480)
    for dock in window.docks.values():
        dock.hide()
    for button in (window.stop_button, window.emergency_button):
        assert button.isVisible()
        assert window.rect().contains(button.mapTo(window, button.rect().bottomRight()))
    session = start_moving(qtbot, window)
    press_escape(window)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    assert session.snapshot().command["x"] < 0.049
    assert session.snapshot().stop_latency_s is not None


def test_both_stop_buttons_work_under_an_open_menu(qtbot, window, open_menu, press_behind_menu):
    session = start_moving(qtbot, window)
    menu = open_menu(window)
    press_behind_menu(menu, window.stop_button)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    assert session.snapshot().command["x"] < 0.049
    assert session.snapshot().latch_reason is None
    menu.close()
    menu = open_menu(window)
    press_behind_menu(menu, window.emergency_button)
    assert session.snapshot().latch_reason is not None
    menu.close()


def test_a_trajectory_is_loaded_played_and_compared(qtbot, window, tmp_path):
    path = write_short_trajectory(tmp_path / "move.csv")
    load(qtbot, window, path)
    panel = window.panels["trajectory"]
    qtbot.waitUntil(panel.transport.play.isEnabled, timeout=LONG_MS)
    with qtbot.waitSignal(window.workbench.run_changed, timeout=LONG_MS):
        qtbot.mouseClick(panel.transport.play, Qt.MouseButton.LeftButton)
    run = window.workbench.run
    assert run.completed
    tap = next(tap for tap in run.comparison.taps if tap.tap == "meas")
    assert tap.rms == pytest.approx(tap.noise_floor, rel=0.25)
    trajectory = read_record(path)
    row = np.searchsorted(run.record.time_s, trajectory.time_s + 1e-3, side="right") - 1
    np.testing.assert_array_equal(
        run.record.signal("thx", Tap.CMD)[row], trajectory.signal("thx", Tap.CMD)
    )
    assert window.panels["comparison"].table.rowCount() == len(run.comparison.taps)
    assert get_notice_texts(window) == []


def test_a_trajectory_beyond_a_limit_is_shown_but_cannot_be_played(qtbot, window, tmp_path):
    path = tmp_path / "far.csv"
    path.write_text("t [s],x [mm]\n0,27.5\n1,99\n", "utf-8")
    load(qtbot, window, path)
    panel = window.panels["trajectory"]
    verdict = panel.verdict.text()
    assert verdict.startswith("Not playable: ")
    assert "x" in verdict
    assert "99 mm" in verdict
    assert "55 mm" in verdict
    assert "Violation(" not in verdict
    with qtbot.waitSignal(window.workbench.refreshed):
        pass
    assert not panel.transport.play.isEnabled()
    window.workbench.play()
    assert "99" in get_notice_texts(window)[0]
    assert window.workbench.session.snapshot().activity is DeviceState.IDLE


BAD_FILES = {
    "empty.csv": b"",
    "binary.csv": b"\x00\x01\x02\xff",
    "unit.csv": b"t [s],x [kg]\n0,1\n",
    "number.csv": b"t [s],x [mm]\n0,nan\n",
    "time.csv": b"t [s],x [mm]\n1,1\n0,1\n",
}


@pytest.mark.parametrize("use", ["planner.load_trajectory", "records.open_record"])
def test_a_bad_file_is_one_notice_and_changes_nothing(qtbot, window, tmp_path, use):
    load(qtbot, window, write_short_trajectory(tmp_path / "good.csv"))
    plan = window.workbench.plan
    for name, content in BAD_FILES.items():
        (tmp_path / name).write_bytes(content)
    (tmp_path / "folder.csv").mkdir()
    for name in (*BAD_FILES, "folder.csv", "missing.csv"):
        window.use_file_with_columns(tmp_path / name, attrgetter(use)(window.workbench))
        qtbot.waitUntil(lambda: get_notice_texts(window) != [], timeout=LONG_MS)
        qtbot.waitUntil(lambda: not window.workbench.busy, timeout=LONG_MS)
        (notice,) = window.notices.notices()
        assert name in notice.text
        assert window.workbench.plan is plan
        assert window.workbench.run is None
        notice.closed.emit()


def test_an_opened_record_is_compared_with_the_model(qtbot, window, shared_dir):
    path = shared_dir / "examples" / "example_1" / "train_1.csv.gz"
    with qtbot.waitSignal(window.workbench.run_changed, timeout=LONG_MS):
        window.use_file_with_columns(path, window.workbench.records.open_record)
    tap = next(
        t for t in window.workbench.run.comparison.taps if (t.axis, t.tap) == ("thx", "meas")
    )
    assert tap.rms > 10 * tap.noise_floor  # its hysteresis


def test_any_robot_gets_its_window(qtbot, make_robot_window):
    for robot in ("emps", "fsm"):
        window = make_robot_window(robot)
        assert set(window.panels["control"].rows) == set(window.workbench.robot.axes)
        assert get_notice_texts(window) == []


@pytest.fixture
def questions(monkeypatch):
    """The questions of the window; the first is answered with Stay, the others with Leave."""
    boxes = []

    def click_answer(box):
        boxes.append(box)
        next(b for b in box.buttons() if (b is box.defaultButton()) == (len(boxes) == 1)).click()

    monkeypatch.setattr(QMessageBox, "exec", click_answer)
    return boxes


def play_long(qtbot, window, tmp_path):
    """Load a trajectory of 20 s and play its beginning."""
    load(qtbot, window, write_short_trajectory(tmp_path / "long.csv", seconds=20.0))
    session = window.workbench.session
    window.workbench.play()
    qtbot.waitUntil(lambda: session.snapshot().progress > 0.005, timeout=LONG_MS)
    return session


def test_every_playback_is_saved_to_its_own_file_and_elsewhere_on_request(
    qtbot, window, tmp_path, questions, monkeypatch
):
    bench = window.workbench
    window.ask_save()
    assert "no record to save" in get_notice_texts(window)[0]
    load(qtbot, window, write_short_trajectory(tmp_path / "move.csv"))
    for count in (1, 2):
        with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
            bench.play()
        qtbot.waitUntil(lambda: bench.records.unsaved is None, timeout=LONG_MS)
        assert len(list(bench.played_folder.glob("*_move.csv.gz"))) == count
        qtbot.waitUntil(lambda: bench.session.at_rest, timeout=LONG_MS)
    target = tmp_path / "saved.csv"
    monkeypatch.setattr(QFileDialog, "show", lambda dialog: dialog.fileSelected.emit(str(target)))
    window.ask_save()
    qtbot.waitUntil(target.exists, timeout=LONG_MS)
    for path in (max(bench.played_folder.iterdir()), target):
        np.testing.assert_array_equal(read_record(path).values, bench.record.values)
    window.close()
    qtbot.waitUntil(window.isHidden, timeout=LONG_MS)
    assert not questions


def test_closing_with_an_unsaved_playback_asks_first(qtbot, window, tmp_path, questions):
    window.workbench.played_folder.write_text("no folder", "utf-8")
    load(qtbot, window, write_short_trajectory(tmp_path / "move.csv"))
    window.workbench.play()
    qtbot.waitUntil(
        lambda: any("cannot be created" in n for n in get_notice_texts(window)), timeout=LONG_MS
    )
    assert not window.close()
    assert window.isVisible()
    window.close()
    qtbot.waitUntil(window.isHidden, timeout=LONG_MS)
    assert len(questions) == 2
    assert questions[0].defaultButton().text() == "Stay"
    assert "is not saved" in questions[0].text()


def test_quitting_during_a_playback_asks_first_and_keeps_what_was_played(
    qtbot, window, tmp_path, questions
):
    session = play_long(qtbot, window, tmp_path)
    assert not window.close()
    assert session.snapshot().stop is None  # Stay changes nothing
    assert "A trajectory is playing" in questions[0].text()
    assert not window.close()  # until the machine is at rest and the record is saved
    assert session.snapshot().stop is not None
    qtbot.waitUntil(window.isHidden, timeout=LONG_MS)
    assert len(questions) == 2
    assert len(list(window.workbench.played_folder.glob("*_long.csv.gz"))) == 1


def test_the_window_stays_open_until_a_stopped_playback_is_handled(qtbot, window, tmp_path):
    bench, events = window.workbench, []
    bench.machine._event_received.disconnect()
    bench.machine._event_received.connect(events.append)
    session = play_long(qtbot, window, tmp_path)
    bench.stop()
    qtbot.waitUntil(lambda: any(isinstance(e, PlaybackFinished) for e in events), timeout=LONG_MS)
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)
    assert bench.has_unhandled_playback
    assert not window.close()
    with qtbot.waitSignal(bench.run_changed, timeout=LONG_MS):
        for event in events:
            bench.machine._on_event(event)
    assert not bench.run.completed
    assert 0 < bench.run.record.duration_s < 19
    assert any("stopped after" in text for text in get_notice_texts(window))
    qtbot.waitUntil(window.isHidden, timeout=LONG_MS)
    assert len(list(bench.played_folder.glob("*_long.csv.gz"))) == 1


def test_a_record_is_saved_even_if_its_comparison_fails(qtbot, window, tmp_path, monkeypatch):
    monkeypatch.setattr(
        "rotemina.app.workbench.played_records.compare_with_model",
        lambda *_, **__: (_ for _ in ()).throw(InputError("no")),
    )
    load(qtbot, window, write_short_trajectory(tmp_path / "move.csv"))
    window.workbench.play()
    qtbot.waitUntil(lambda: get_notice_texts(window) == ["no"], timeout=LONG_MS)
    qtbot.waitUntil(lambda: window.workbench.records.unsaved is None, timeout=LONG_MS)
    assert list(window.workbench.played_folder.iterdir())


def test_theme_and_layout_survive_a_restart(qtbot, make_robot_window, settings):
    first = make_robot_window()
    first.use_theme("light")
    first.docks["control"].hide()
    first.close()
    qtbot.waitUntil(first.isHidden, timeout=LONG_MS)  # background work of the start ends first
    second = make_robot_window()
    assert second.workbench.theme.name == "light"
    assert second.docks["control"].isHidden()


def test_the_window_opens_with_invalid_preferences(make_robot_window, settings):
    for key in ("window.geometry", "window.state"):
        settings.set(key, "no layout at all")
    settings.set("window.theme", "pink")
    assert make_robot_window().isVisible()


class RaisingPanel(module.Panel):
    title = "Bad"

    def __init__(self, workbench):
        raise RuntimeError("cannot be made")


@pytest.mark.every_panel
def test_a_bad_panel_is_named_and_left_out(make_robot_window, monkeypatch):
    good = registry.entry_points(group=ENTRY_POINT_GROUP)
    test_entry = f"{__name__}:RaisingPanel"
    bad = [
        EntryPoint("gone", "no_such_module:Panel", ENTRY_POINT_GROUP),
        EntryPoint("wrong", "pathlib:Path", ENTRY_POINT_GROUP),
        EntryPoint("raising", test_entry, ENTRY_POINT_GROUP),
    ]
    monkeypatch.setattr(EntryPoint, "load", make_entry_loader(EntryPoint.load, test_entry))
    monkeypatch.setattr(registry, "entry_points", lambda group: [*good, *bad])
    window = make_robot_window()
    window.panels.make_all()
    assert list(window.panels) == BUILT_IN
    assert "raising" not in window.docks
    message = " ".join(get_notice_texts(window))
    for name in ("gone", "wrong", "raising"):
        assert f"'{name}' is left out" in message


def make_entry_loader(original_load, test_entry):
    """Return a loader for this module too; imported by path, no entry point can name it."""
    return lambda point: RaisingPanel if point.value == test_entry else original_load(point)


def test_unreadable_preferences_are_reported_with_their_path(qtbot, tmp_path):
    path = tmp_path / "settings.json"
    path.write_text("{", "utf-8")
    session = MotionSession(Simulator(load_robot("rotemina")))
    window = window_run.make_window(session, UserSettings(path), tmp_path / "played")
    qtbot.addWidget(window)
    message = window.notices.notices()[0].text
    window.workbench.close()
    assert f"{path}:1: not valid JSON" in message
    assert f"kept as {tmp_path / 'settings.damaged-1.json'}" in message


def test_the_first_steps_take_four_clicks_and_do_not_return(qtbot, window, tmp_path, monkeypatch):
    card, bench = window.first_steps, window.workbench
    assert card.isHidden()  # except on a first start
    short = read_record(write_short_trajectory(tmp_path / "move.csv"))
    monkeypatch.setattr("rotemina.app.shell.help.first_steps.make_example", lambda _: short)
    card.offer()
    qtbot.waitUntil(lambda: card._marks[0].text() == "1", timeout=LONG_MS)
    assert not card.play.isEnabled()
    assert "load one first" in card.play.toolTip()
    for button in (card.simulator_button, card.load, card.play, card.diagnose):
        qtbot.waitUntil(button.isEnabled, timeout=LONG_MS)
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: bench.run is not None and card.isHidden(), timeout=LONG_MS)
    card.offer()
    assert card.isHidden()
