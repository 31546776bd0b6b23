"""The window as an operator meets it, on the simulator and its real threads."""

import threading
from importlib.metadata import EntryPoint

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QFileDialog, QMessageBox, QTextEdit, QWidget

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import PlaybackFinished
from rotemina.app.settings import Settings
from rotemina.app.shell import main_window as module
from rotemina.app.shell import window_run
from rotemina.app.shell.deferred_panels import LatePanels
from rotemina.app.shell.layouts import TUNE
from rotemina.app.shell.panel_host import GROUP
from rotemina.app.widgets.scroll_areas import frame_of
from rotemina.drivers import registry
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.records.reading import read_record
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import load_robot

PANELS = ("comparison",)

LONG_MS = 30_000
BUILT_IN = ["job", "events", "control", "plots", "trajectory", "microscope", "comparison"]
BUILT_IN += ["connection"]
BUILT_IN += ["teleoperation", "inputs", "identification", "calibration"]
BUILT_IN += ["compensation", "penetration"]
BUILT_IN += ["effects", "gap", "faults", "recorder", "view3d", "plate"]


def short_trajectory(path, seconds=0.4, height=2e-4):
    """A smooth move of thx and back."""
    time_s = np.arange(int(seconds * 500) + 1) / 500
    command = 5.81775e-4 + height * np.sin(np.pi * time_s / time_s[-1]) ** 2
    write_record(Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"}), path)
    return path


def notices(window):
    return [notice.text for notice in window.notices.notices()]


def load(qtbot, window, path):
    with qtbot.waitSignal(window.workbench.plan_changed, timeout=LONG_MS):
        window.use_file(path, window.workbench.load_trajectory)


@pytest.mark.every_panel
def test_all_built_in_panels_are_there_and_nothing_is_broken(window):
    assert list(window.panels) == BUILT_IN
    assert notices(window) == []
    behind = {"microscope"}  # the second tab of the centre
    assert {name for name, one in window.panels.items() if not one.isVisibleTo(window)} == behind


@pytest.mark.every_panel
def test_panels_out_of_sight_are_made_by_and_by(qtbot, window):
    with qtbot.waitSignal(window.workbench.busy_changed, timeout=LONG_MS):
        window.workbench.work("any", "Reading …", lambda: None, lambda _: None)
    assert window.panels.waiting == ()  # none is made so late that it misses what was read
    for name, dock in window.docks.items():
        assert dock.widget().widget() is window.panels[name]


@pytest.mark.every_panel
def test_a_panel_is_made_when_its_dock_comes_into_sight(qtbot, make_robot_window, monkeypatch):
    monkeypatch.setattr(LatePanels, "start", lambda _: None)
    monkeypatch.setattr(LatePanels, "_before_work", lambda *_: None)
    window = make_robot_window()
    for name in ("gap", "plate", "plate"):
        assert (name in window.panels.made) == (window.docks[name].widget() is not None)
        window.docks[name].raise_()
        qtbot.waitUntil(lambda name=name: name in window.panels.made, timeout=LONG_MS)
    assert window.panels.waiting
    assert "view3d" not in window.panels.made
    window.bring_up("view3d")
    assert window.docks["view3d"].widget().widget() is window.panels.made["view3d"]
    window.bring_up("nothing of that name")


@pytest.mark.every_panel
def test_what_comes_into_sight_is_laid_out_before_it_is_painted(make_robot_window, monkeypatch):
    monkeypatch.setattr(LatePanels, "start", lambda _: None)
    monkeypatch.setattr(LatePanels, "_before_work", lambda *_: None)
    window = make_robot_window()
    for name in ("gap", "plate"):
        window.docks[name].raise_()
        assert name not in window.panels.made
        window.late_panels.make_seen()
        laid_out = [widget.geometry() for widget in window.findChildren(QWidget)]
        QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest.value)
        assert laid_out == [widget.geometry() for widget in window.findChildren(QWidget)]


@pytest.mark.every_panel
def test_what_a_layout_shows_is_made_in_small_steps_once_the_window_is_in_use(
    make_robot_window, monkeypatch
):
    monkeypatch.setattr(LatePanels, "start", lambda _: None)
    monkeypatch.setattr(LatePanels, "_before_work", lambda *_: None)
    window = make_robot_window()
    late, panels = window.late_panels, window.panels
    late._since.start()
    window.arrangement.arrange(TUNE)
    wanted = ("connection", "identification")
    assert not panels.made.keys() & set(wanted)
    for _ in range(100):
        made = len(panels.made)
        placed = sum(dock.widget() is not None for dock in window.docks.values())
        late.make_seen()
        steps = len(panels.made) - made
        steps += sum(dock.widget() is not None for dock in window.docks.values()) - placed
        assert steps <= 1
    for name in wanted:
        assert window.docks[name].widget() is frame_of(panels.made[name])


@pytest.mark.every_panel
def test_others_wait_for_what_they_need(qtbot, make_robot_window, monkeypatch):
    monkeypatch.setattr(LatePanels, "start", lambda _: None)
    monkeypatch.setattr(LatePanels, "_before_work", lambda *_: None)
    window, loaded = make_robot_window(), threading.Event()
    thread = threading.Thread(target=loaded.wait)

    def load():
        thread.start()
        return thread

    late, waiting = window.late_panels, window.panels.waiting
    late.load = load
    for _ in range(3):
        late._make_next()
    assert thread.is_alive()
    assert window.panels.waiting == waiting != ()
    loaded.set()
    thread.join()
    with qtbot.waitSignal(late.done, timeout=LONG_MS):
        late._next.start()
    assert window.panels.waiting == ()


def test_stop_is_always_in_sight_and_stops_on_escape(qtbot, window, press_escape):
    window.resize(640, 480)
    for dock in window.docks.values():
        dock.hide()
    assert window.stop_button.isVisible()
    assert window.rect().contains(
        window.stop_button.mapTo(window, window.stop_button.rect().bottomRight())
    )
    session = window.workbench.session
    session.go_to({"x": 0.05})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    window.activateWindow()
    press_escape(window)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    assert session.snapshot().command["x"] < 0.049
    assert session.snapshot().stop_latency_s is not None


def test_escape_stops_even_while_a_dialog_is_open(qtbot, window, press_escape):
    session = window.workbench.session
    session.go_to({"x": 0.05})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    dialog = QMessageBox(window)
    dialog.open()
    press_escape(dialog)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    assert session.snapshot().command["x"] < 0.049
    assert dialog.isHidden()


def test_a_trajectory_is_loaded_played_and_compared(qtbot, window, tmp_path):
    path = short_trajectory(tmp_path / "move.csv")
    load(qtbot, window, path)
    panel = window.panels["trajectory"]
    qtbot.waitUntil(panel.transport.play.isEnabled, timeout=LONG_MS)
    with qtbot.waitSignal(window.workbench.run_changed, timeout=LONG_MS):
        qtbot.mouseClick(panel.transport.play, Qt.MouseButton.LeftButton)
    run = window.workbench.run
    assert run.completed
    tap = next(tap for tap in run.comparison.taps if tap.tap == "meas")
    assert tap.rms == pytest.approx(tap.noise_floor, rel=0.25)
    asked = read_record(path)
    row = np.searchsorted(run.record.time_s, asked.time_s + 1e-3, side="right") - 1
    np.testing.assert_array_equal(
        run.record.signal("thx", Tap.CMD)[row], asked.signal("thx", Tap.CMD)
    )
    assert window.panels["comparison"].table.rowCount() == len(run.comparison.taps)
    assert notices(window) == []


def test_a_stopped_playback_keeps_what_was_played(qtbot, window, tmp_path):
    load(qtbot, window, short_trajectory(tmp_path / "long.csv", seconds=20.0))
    session = window.workbench.session
    window.workbench.play()
    qtbot.waitUntil(lambda: session.snapshot().progress > 0.005, timeout=LONG_MS)
    with qtbot.waitSignal(window.workbench.run_changed, timeout=LONG_MS):
        window.workbench.stop()
    assert not window.workbench.run.completed
    assert 0 < window.workbench.run.record.duration_s < 19
    assert "stopped after" in notices(window)[0]


def test_a_trajectory_beyond_a_limit_is_shown_but_cannot_be_played(qtbot, window, tmp_path):
    path = tmp_path / "far.csv"
    path.write_text("t [s],x [mm]\n0,27.5\n1,99\n", "utf-8")
    load(qtbot, window, path)
    panel = window.panels["trajectory"]
    said = panel.verdict.text()
    assert said.startswith("Not playable: ")
    assert "x" in said
    assert "99 mm" in said
    assert "55 mm" in said
    assert "Violation(" not in said
    with qtbot.waitSignal(window.workbench.refreshed):
        pass
    assert not panel.transport.play.isEnabled()
    window.workbench.play()
    assert "99" in notices(window)[0]
    assert window.workbench.session.snapshot().activity is DeviceState.IDLE


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\x00\x01\x02\xff",
        b"t [s],x [kg]\n0,1\n",
        b"t [s],x [mm]\n0,nan\n",
        b"t [s],x [mm]\n1,1\n0,1\n",
    ],
)
@pytest.mark.parametrize("use", ["load_trajectory", "open_record"])
def test_a_bad_file_is_one_notice_and_changes_nothing(qtbot, window, tmp_path, content, use):
    load(qtbot, window, short_trajectory(tmp_path / "good.csv"))
    plan = window.workbench.plan
    bad = tmp_path / "bad.csv"
    bad.write_bytes(content)
    window.use_file(bad, getattr(window.workbench, use))
    qtbot.waitUntil(lambda: notices(window) != [], timeout=LONG_MS)
    (text,) = notices(window)
    assert "bad.csv" in text
    assert window.workbench.plan is plan
    assert window.workbench.run is None


def test_a_folder_and_a_missing_file_are_notices(qtbot, window, tmp_path):
    for path in (tmp_path, tmp_path / "nothing.csv"):
        window.use_file(path, window.workbench.open_record)
        qtbot.waitUntil(lambda path=path: any(str(path) in n for n in notices(window)))


def test_a_record_is_opened_beside_the_model(qtbot, window, shared_dir):
    path = shared_dir / "examples" / "example_1" / "train_1.csv.gz"
    with qtbot.waitSignal(window.workbench.run_changed, timeout=LONG_MS):
        window.use_file(path, window.workbench.open_record)
    tap = next(
        t for t in window.workbench.run.comparison.taps if (t.axis, t.tap) == ("thx", "meas")
    )
    assert tap.rms > 10 * tap.noise_floor  # its hysteresis


def test_any_robot_gets_its_window(qtbot, make_robot_window):
    for robot in ("emps", "picma", "fsm"):
        window = make_robot_window(robot)
        assert set(window.panels["control"].rows) == set(window.workbench.robot.axes)
        assert notices(window) == []


def played(qtbot, window, path):
    load(qtbot, window, short_trajectory(path))
    with qtbot.waitSignal(window.workbench.run_changed, timeout=LONG_MS):
        window.workbench.play()


@pytest.fixture
def question(monkeypatch):
    """What the window asks, and what it is answered."""
    asked = []

    def answer(box):
        """Stay the first time, leave the second."""
        asked.append(box)
        next(b for b in box.buttons() if (b is box.defaultButton()) == (len(asked) == 1)).click()

    monkeypatch.setattr(QMessageBox, "exec", answer)
    return asked


def test_saving_asks_where(qtbot, window, tmp_path, monkeypatch):
    window.ask_save()
    assert "no record to save" in notices(window)[0]
    played(qtbot, window, tmp_path / "move.csv")
    target = tmp_path / "saved.csv"
    monkeypatch.setattr(QFileDialog, "show", lambda dialog: dialog.fileSelected.emit(str(target)))
    window.ask_save()
    qtbot.waitUntil(target.exists, timeout=LONG_MS)
    np.testing.assert_array_equal(read_record(target).values, window.workbench.run.record.values)


def test_every_playback_is_kept_in_a_file_by_itself(qtbot, window, tmp_path, question):
    for count in (1, 2):
        played(qtbot, window, tmp_path / "move.csv")
        qtbot.waitUntil(lambda: window.workbench.unsaved is None, timeout=LONG_MS)
        assert len(list(window.workbench.played_folder.glob("*_move.csv.gz"))) == count
    newest = max(window.workbench.played_folder.iterdir())
    np.testing.assert_array_equal(read_record(newest).values, window.workbench.record.values)
    window.close()
    qtbot.waitUntil(window.isHidden, timeout=LONG_MS)
    assert not question


def test_a_playback_that_could_not_be_kept_is_not_lost_without_asking(
    qtbot, window, tmp_path, question
):
    window.workbench.played_folder.write_text("no folder", "utf-8")
    played(qtbot, window, tmp_path / "move.csv")
    qtbot.waitUntil(lambda: any("cannot be created" in n for n in notices(window)), timeout=LONG_MS)
    assert not window.close()
    assert window.isVisible()
    window.close()
    qtbot.waitUntil(window.isHidden, timeout=LONG_MS)
    assert len(question) == 2
    assert question[0].defaultButton().text() == "Stay"  # what Enter chooses
    assert "is not saved" in question[0].text()


def test_quitting_during_a_playback_asks_first_and_keeps_what_was_played(
    qtbot, window, tmp_path, question
):
    load(qtbot, window, short_trajectory(tmp_path / "long.csv", seconds=20.0))
    session = window.workbench.session
    window.workbench.play()
    qtbot.waitUntil(lambda: session.snapshot().progress > 0.005, timeout=LONG_MS)
    assert not window.close()
    assert session.snapshot().stop is None  # to stay changes nothing
    assert "A trajectory is playing" in question[0].text()
    assert not window.close()  # until it rests, and the record is in its file
    assert session.snapshot().stop is not None
    qtbot.waitUntil(window.isHidden, timeout=LONG_MS)
    assert len(question) == 2
    assert len(list(window.workbench.played_folder.glob("*_long.csv.gz"))) == 1


def test_the_window_stays_until_it_has_heard_of_what_was_played(qtbot, window, tmp_path):
    bench, held = window.workbench, []
    bench._happened.disconnect()
    bench._happened.connect(held.append)
    load(qtbot, window, short_trajectory(tmp_path / "long.csv", seconds=20.0))
    bench.play()
    qtbot.waitUntil(lambda: bench.session.snapshot().progress > 0.005, timeout=LONG_MS)
    bench.stop()
    qtbot.waitUntil(lambda: any(isinstance(e, PlaybackFinished) for e in held), timeout=LONG_MS)
    qtbot.waitUntil(lambda: bench.session.at_rest, timeout=LONG_MS)
    assert bench.untold
    assert not window.close()
    for event in held:
        bench._on_event(event)
    qtbot.waitUntil(window.isHidden, timeout=LONG_MS)
    assert len(list(bench.played_folder.glob("*_long.csv.gz"))) == 1


def test_a_record_whose_comparison_fails_is_kept_all_the_same(qtbot, window, tmp_path, monkeypatch):
    monkeypatch.setattr(
        "rotemina.app.shell.played_records.compared",
        lambda *_, **__: (_ for _ in ()).throw(InputError("no")),
    )
    load(qtbot, window, short_trajectory(tmp_path / "move.csv"))
    window.workbench.play()
    qtbot.waitUntil(lambda: notices(window) == ["no"], timeout=LONG_MS)
    qtbot.waitUntil(lambda: window.workbench.unsaved is None, timeout=LONG_MS)
    assert list(window.workbench.played_folder.iterdir())


def test_the_stop_button_works_under_an_open_menu(qtbot, window, open_menu, press_behind_menu):
    session = window.workbench.session
    session.go_to({"x": 0.05})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    menu = open_menu(window)
    press_behind_menu(menu, window.stop_button)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    assert session.snapshot().command["x"] < 0.049
    menu.close()


def test_a_key_that_is_held_runs_its_command_once(window):
    shortcuts = [one for one in window.findChildren(QAction) if not one.shortcut().isEmpty()]
    repeated = [one.text() for one in shortcuts if one.autoRepeat()]
    assert "&Play or pause" in [one.text() for one in shortcuts]
    assert repeated == []  # play, pause and resume, as long as it is held


def test_theme_and_layout_survive_a_restart(qtbot, make_robot_window, settings):
    first = make_robot_window()
    first.use_theme("light")
    first.docks["control"].hide()
    first.close()
    qtbot.waitUntil(first.isHidden, timeout=LONG_MS)  # what was begun at the start is ended first
    second = make_robot_window()
    assert second.workbench.theme.name == "light"
    assert second.docks["control"].isHidden()


def test_spoilt_preferences_never_keep_the_window_shut(make_robot_window, settings):
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
    good = registry.entry_points(group=GROUP)
    here = f"{__name__}:RaisingPanel"
    bad = [
        EntryPoint("gone", "no_such_module:Panel", GROUP),
        EntryPoint("wrong", "pathlib:Path", GROUP),
        EntryPoint("raising", here, GROUP),
    ]
    monkeypatch.setattr(EntryPoint, "load", _load_from_here(EntryPoint.load, here))
    monkeypatch.setattr(registry, "entry_points", lambda group: [*good, *bad])
    window = make_robot_window()
    window.panels.make_all()
    assert list(window.panels) == BUILT_IN
    assert "raising" not in window.docks
    said = " ".join(notices(window))
    for name in ("gone", "wrong", "raising"):
        assert f"'{name}' is left out" in said


def _load_from_here(load, here):
    """Test modules are imported by path, so an entry point cannot name one."""
    return lambda point: RaisingPanel if point.value == here else load(point)


def test_a_notice_is_plain_text_and_can_be_closed(qtbot, window):
    window.workbench.notify(module.Level.ERROR, "<b>file</b><script>x</script>.csv is bad")
    (notice,) = window.notices.notices()
    assert notice.findChild(QTextEdit).toPlainText() == "<b>file</b><script>x</script>.csv is bad"
    notice.closed.emit()
    assert window.notices.notices() == []


def test_preferences_that_cannot_be_read_are_told_of_with_the_place_of_the_file(qtbot, tmp_path):
    path = tmp_path / "settings.json"
    path.write_text("{", "utf-8")
    session = MotionSession(Simulator(load_robot("rotemina")))
    window = window_run.make_window(session, Settings(path), tmp_path / "played")
    qtbot.addWidget(window)
    told = window.notices.notices()[0].text
    window.workbench.close()
    assert f"{path}:1: not valid JSON" in told
    assert f"kept as {tmp_path / 'settings.damaged-1.json'}" in told


def test_the_first_steps_are_four_clicks_and_gone_for_good(qtbot, window, tmp_path, monkeypatch):
    card, bench = window.first_steps, window.workbench
    assert card.isHidden()  # but on a first start
    short = read_record(short_trajectory(tmp_path / "move.csv"))
    monkeypatch.setattr("rotemina.app.shell.first_steps.example_for", lambda _: short)
    card.offer()
    qtbot.waitUntil(lambda: card._marks[0].text() == "1", timeout=LONG_MS)
    assert not card.play.isEnabled()
    assert "load one first" in card.play.toolTip()
    for button in (card.stay, card.load, card.play, card.diagnose):
        qtbot.waitUntil(button.isEnabled, timeout=LONG_MS)
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: bench.run is not None and card.isHidden(), timeout=LONG_MS)
    card.offer()
    assert card.isHidden()
