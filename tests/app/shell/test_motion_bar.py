"""Phase, emergency stop and reconnection in the tool bar, and the status line."""

import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget, QFileDialog, QMessageBox, QWidget

from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.panel import Panel
from rotemina.app.shell.header_row import LARGE, SMALL
from rotemina.app.shell.stop_controls import RELEASE_AFTER_S, EmergencyButton, StopWatch
from rotemina.app.shell.workbench import Level
from rotemina.drivers.driver import MachineKind
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.samples import DeviceState
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.first_trajectory import example_for

PANELS = ("gap",)

LONG_MS = 30_000


@pytest.fixture
def button(qtbot, window):
    """The button of the tool bar, with a clock that the test sets."""

    class Set:
        now_s = 100.0

        def __call__(self):
            return self.now_s

    made = EmergencyButton(window.workbench, Set())
    made.setParent(window.centralWidget())
    made.show()
    window.workbench.refreshed.connect(made.refresh)
    qtbot.waitUntil(made.isVisible, timeout=LONG_MS)
    return made


def click(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def test_the_phase_and_the_reason_are_shown(qtbot, window):
    bar, bench = window._bar, window.workbench
    qtbot.waitUntil(lambda: bar.phase.text() == "Ready", timeout=LONG_MS)
    bench.go_to({"x": 0.05})
    qtbot.waitUntil(lambda: bar.phase.text() == "Moving", timeout=LONG_MS)
    qtbot.waitUntil(lambda: bar.doing.text() == "Operator moves X", timeout=LONG_MS)
    assert bar.owner.text() == "Operator"
    bench.emergency_stop()
    qtbot.waitUntil(lambda: bar.doing.text().startswith("Locked by the operator"), timeout=LONG_MS)
    assert bar.phase.property("tone") == "danger"
    qtbot.waitUntil(lambda: bar.owner.text() == "No one is driving", timeout=LONG_MS)


def test_escape_with_shift_latches_and_without_does_not(qtbot, window, press_escape):
    session = window.workbench.session
    press_escape(window)
    assert session.snapshot().latched is None
    session.go_to({"x": 0.05}, speeds={"x": 1e-4})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    dialog = QMessageBox(window)
    dialog.open()
    press_escape(dialog, Qt.KeyboardModifier.ShiftModifier)
    assert session.snapshot().latched == "stop and lock"
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    window.workbench.jog("x", 1e-3)
    assert "release it first" in window.notices.notices()[0].text
    qtbot.waitUntil(window.emergency_button.isChecked, timeout=LONG_MS)
    dialog.close()


@pytest.mark.parametrize(("pause_s", "locked"), [(0.99, True), (1.01, False)])
def test_a_second_escape_within_a_second_locks(window, monkeypatch, pause_s, locked):
    now_s = [100.0]
    monkeypatch.setattr(window._stop_watch._escape, "_clock", lambda: now_s[0])
    session, screen = window.workbench.session, window.windowHandle()
    QTest.keyClick(screen, Qt.Key.Key_Escape)  # which passes its window and widgets in turn
    assert session.snapshot().latched is None
    now_s[0] += pause_s
    QTest.keyClick(screen, Qt.Key.Key_Escape)
    assert (session.snapshot().latched is not None) == locked


def test_escape_that_is_held_repeats_and_does_not_lock(window):
    press = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_Escape, Qt.KeyboardModifier.NoModifier)
    repeated = QKeyEvent(
        QEvent.Type.KeyPress, Qt.Key.Key_Escape, Qt.KeyboardModifier.NoModifier, "", True
    )
    for event in (press, repeated, repeated):
        QApplication.sendEvent(window.windowHandle(), event)
    assert window.workbench.session.snapshot().latched is None
    assert window.workbench.session.stop_asked_s is not None


def test_a_second_press_of_stop_locks(qtbot, window):
    session = window.workbench.session
    click(qtbot, window.stop_button)
    assert session.snapshot().latched is None
    click(qtbot, window.stop_button)
    assert session.snapshot().latched == "stop and lock"


def test_escape_on_the_keypad_of_a_field_latches_too(window, press_escape):
    press_escape(window.panels["control"].rows["x"].target, Qt.KeyboardModifier.ShiftModifier)
    assert window.workbench.session.snapshot().latched is not None


def test_the_button_latches_and_a_later_press_releases(qtbot, window, button):
    session = window.workbench.session
    click(qtbot, button)
    assert session.snapshot().latched is not None
    assert button.isChecked()
    assert "release" in button.text()
    click(qtbot, button)  # in alarm
    assert session.snapshot().latched is not None
    assert button.isChecked()
    button._clock.now_s += RELEASE_AFTER_S
    click(qtbot, button)
    assert session.snapshot().latched is None
    assert not button.isChecked()


def test_a_latch_from_elsewhere_is_shown_and_not_released_at_once(qtbot, window, button):
    window.workbench.emergency_stop()
    qtbot.waitUntil(button.isChecked, timeout=LONG_MS)
    click(qtbot, button)
    assert window.workbench.session.snapshot().latched is not None
    window.workbench.release()
    qtbot.waitUntil(lambda: not button.isChecked(), timeout=LONG_MS)


def test_stop_and_emergency_stop_stay_in_a_small_window(window):
    window.resize(640, 480)
    for dock in window.docks.values():
        dock.hide()
    for button in (window.stop_button, window.emergency_button):
        assert button.isVisible()
        corner = button.mapTo(window, button.rect().bottomRight())
        assert window.rect().contains(corner)


def test_the_status_line_tells_link_age_and_the_driver_in_use(qtbot, window):
    status = window._status
    qtbot.waitUntil(lambda: "simulator: Ready" in status.text(), timeout=LONG_MS)
    assert "old" in status.text()
    window.workbench.stop()
    qtbot.waitUntil(lambda: "last stop" in status.text(), timeout=LONG_MS)
    window.workbench.let_go()
    qtbot.waitUntil(lambda: "simulator: Disconnected" in status.text(), timeout=LONG_MS)


def test_escape_stops_under_a_modal_dialog_and_a_file_dialog(qtbot, window, press_escape, tmp_path):
    session = window.workbench.session
    qtbot.waitUntil(lambda: session.snapshot().position_known, timeout=LONG_MS)
    for dialog in (QMessageBox(window), QFileDialog(window, "Open", str(tmp_path))):
        dialog.open()
        assert dialog.findChildren(QWidget), "a dialog of the desktop's own sees the keys alone"
        session.go_to({"x": 0.05}, speeds={"x": 1e-4})
        qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
        press_escape(dialog)
        qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
        assert session.snapshot().stop.by == OPERATOR
        session.stop()
        dialog.close()


class AsksFirst(Panel):
    """A panel whose constructor asks something; meanwhile Esc is pressed in what it opened."""

    title = "asks first"

    def __init__(self, workbench):
        super().__init__(workbench)
        dialog = QMessageBox(self)
        dialog.show()
        QTest.qWaitForWindowActive(dialog)
        QTest.keyClick(dialog.windowHandle(), Qt.Key.Key_Escape)
        dialog.close()


def test_escape_stops_in_a_window_that_a_panel_opens_while_it_is_made(qtbot, window):
    panels, session = window.panels, window.workbench.session
    qtbot.waitUntil(lambda: session.snapshot().position_known, timeout=LONG_MS)
    for name in ("one", "another"):
        session.go_to({"x": 0.05}, speeds={"x": 1e-4})
        qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
        panels.kinds[name] = AsksFirst
        window.docks[name] = QDockWidget(window)
        panels.make(name)
        qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
        assert session.snapshot().stop.by == OPERATOR


def moving(qtbot, session):
    """Set an axis in motion, and wait for it."""
    qtbot.waitUntil(lambda: session.snapshot().position_known, timeout=LONG_MS)
    session.go_to({"x": 0.05}, speeds={"x": 1e-4})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)


def test_escape_stops_in_a_menu_that_a_key_has_just_opened(qtbot, window):
    session, menu = window.workbench.session, window.menuBar().actions()[0].menu()
    moving(qtbot, session)
    held = Qt.KeyboardModifier.NoModifier
    kinds = QEvent.Type.KeyPress, QEvent.Type.KeyRelease
    letter = [QKeyEvent(kind, Qt.Key.Key_F, held, "f") for kind in kinds]
    QApplication.sendEvent(window.windowHandle(), letter[0])
    menu.popup(window.mapToGlobal(QPoint(0, 0)))  # as that key does
    # No event loop has run since: nobody can know the window of the menu yet.
    escape = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_Escape, held)
    QApplication.sendEvent(menu.windowHandle(), escape)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    assert session.snapshot().stop.by == OPERATOR
    menu.close()


def test_escape_stops_in_a_window_that_opened_by_itself_and_has_no_focus(qtbot, window):
    session = window.workbench.session
    moving(qtbot, session)
    beside = QWidget()
    qtbot.addWidget(beside)
    beside.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
    beside.show()
    QTest.qWait(250)  # longer than between two looks for windows
    QTest.keyClick(beside.windowHandle(), Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    assert session.snapshot().stop.by == OPERATOR


def test_a_press_locks_although_the_last_frame_showed_a_lock_that_is_released(qtbot, window):
    session, button = window.workbench.session, window.emergency_button
    session.emergency_stop("a stick")
    button.refresh(session.snapshot())
    button._latched_at_s -= 10.0  # long ago: a press would release it
    session.release()
    assert button.isChecked()  # no frame has come since
    click(qtbot, button)
    assert session.snapshot().latched == "stop and lock"


class Counted(StopWatch):
    """Counts what it is called for."""

    called = 0

    def eventFilter(self, watched, event):  # noqa: N802 (Qt's name)
        self.called += 1
        return super().eventFilter(watched, event)


def test_what_widgets_send_each_other_costs_the_watch_nothing(window):
    buttons = window.stop_button, window.emergency_button
    watch = Counted(window.workbench, *buttons, window)
    watch.start()
    QApplication.sendEvent(window.windowHandle(), QEvent(QEvent.Type.User))
    assert watch.called == 1
    QApplication.sendEvent(window.stop_button, QEvent(QEvent.Type.User))
    assert watch.called == 1
    watch.close()


@pytest.mark.parametrize("name", ["gap", "no such panel"])
def test_escape_stops_once_a_panel_was_made_or_could_not_be(qtbot, window, press_escape, name):
    session = window.workbench.session
    qtbot.waitUntil(lambda: session.snapshot().position_known, timeout=LONG_MS)
    window.panels.kinds["no such panel"] = Panel.__new__  # which is no way to make one
    window.panels.make(name)
    session.go_to({"x": 0.05}, speeds={"x": 1e-4})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    press_escape(window)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)


def test_no_dialog_is_the_desktops_own(window):
    assert QApplication.testAttribute(Qt.ApplicationAttribute.AA_DontUseNativeDialogs)


def test_who_stopped_is_shown_until_something_moves(qtbot, window):
    bar, session = window._bar, window.workbench.session
    qtbot.waitUntil(lambda: bar.phase.text() == "Ready", timeout=LONG_MS)
    window.workbench.stop()
    told = f"Stopped by the operator at {session.snapshot().stop.at:%H:%M:%S}"
    qtbot.waitUntil(lambda: bar.doing.text().startswith(told), timeout=LONG_MS)
    session.stop("the window does not respond")
    qtbot.waitUntil(lambda: bar.doing.text().startswith("Stopped by the program"), timeout=LONG_MS)
    assert ": the window does not respond." in bar.doing.text()
    window.workbench.jog("x", 1e-4)
    at_rest = "At rest; every axis can be moved."
    qtbot.waitUntil(lambda: bar.doing.text() == at_rest, timeout=LONG_MS)
    assert bar.phase.text() == "Ready"


# --- the header -----------------------------------------------------------------------------------


def test_a_stop_stands_beside_no_ready_and_a_released_lock_leaves_nothing(qtbot, window):
    bar, bench = window._bar, window.workbench
    qtbot.waitUntil(lambda: bar.phase.text() == "Ready", timeout=LONG_MS)
    assert bar.doing.text() == "At rest; every axis can be moved."
    bench.stop()
    qtbot.waitUntil(lambda: bar.phase.text() == "Stopped", timeout=LONG_MS)
    assert bar.doing.text().startswith("Stopped by the operator at ")
    bench.emergency_stop()
    qtbot.waitUntil(lambda: bar.phase.text() == "Locked", timeout=LONG_MS)
    assert bar.help.text() == "Release"
    assert not bar.help.isEnabled()  # a second press that was meant for something else
    qtbot.waitUntil(bar.help.isEnabled, timeout=LONG_MS)
    click(qtbot, bar.help)
    qtbot.waitUntil(lambda: bar.phase.text() == "Ready", timeout=LONG_MS)
    assert bar.doing.text() == "At rest; every axis can be moved."
    assert not bar.help.isVisible()


def test_the_header_has_the_sizes_of_both_screens(window):
    bar = window._bar
    for width, height, sizes in ((1920, 1080, LARGE), (1280, 800, SMALL)):
        window.resize(width, height)
        QApplication.processEvents()
        assert bar.height() == pytest.approx(sizes.height, abs=2)
        parts = (bar.badge, bar.emergency, bar.stop)
        for part, size in zip(parts, (sizes.badge, sizes.lock, sizes.stop), strict=True):
            assert part.size() == size
            assert part.fontMetrics().height() <= part.height()
        assert bar.stop.width() * 2 == pytest.approx(bar.emergency.width() * 3, rel=0.01)
        edges = [bar.badge, bar.state, bar.model, bar.events, bar.emergency, bar.stop]
        places = [one.mapTo(window, QPoint()).x() for one in edges]
        ends = [x + one.width() for x, one in zip(places, edges, strict=True)]
        assert all(end <= start for end, start in zip(ends, places[1:], strict=False))
        assert ends[-1] <= width


def test_what_may_be_a_real_machine_is_shown_as_one(window, monkeypatch):
    bar, session = window._bar, window.workbench.session
    assert window.windowTitle().startswith("RoTeMiNa – SIMULATOR nominal – ")
    for port, kind, machine in (
        ("/dev/pts/7", None, "MACHINE"),
        ("/dev/pts/7", MachineKind.VIRTUAL, "VIRTUAL BOARDS"),
        ("/dev/ttyUSB0", MachineKind.REAL, "MACHINE"),
        ("socket://h:1", MachineKind.VIRTUAL, "VIRTUAL BOARDS"),
    ):
        boards = MC68HC11(window.workbench.robot, {"port": port})
        boards._machine_kind = kind  # as it said when it was opened
        with monkeypatch.context() as other:
            other.setattr(type(session), "driver", boards)
            bar.refresh(session.snapshot())
        assert window.windowTitle().startswith(f"RoTeMiNa – {machine} {port} – ")
        assert window._top_line.isVisible() is (machine == "MACHINE")
        assert window._top_line.geometry().getRect() == (0, 0, window.width(), 4)
        assert not bar.badge.grab().toImage().isNull()


def test_what_is_noticed_is_counted_until_the_log_is_opened(qtbot, window):
    bar = window._bar
    window.workbench.notify(Level.WARNING, "something")
    window.workbench.notify(Level.INFO, "a word")
    assert bar.events.text() == "Warnings 1"
    click(qtbot, bar.events)
    assert window.log_page.isVisible()
    assert bar.events.text() == "Warnings 0"


def test_play_waits_until_what_was_switched_has_settled(qtbot, window):
    bench = window.workbench
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("example", example_for(bench.robot))
    told = []
    bench.noticed.connect(lambda _, text: told.append(text))
    bench.session.service.set_effects(
        [AxisEffect(axis="zn", id="hysteresis", parameters={"width": 6e-6})]
    )
    bench.play()  # before the machine has taken them
    qtbot.waitUntil(
        lambda: bench.session.snapshot().activity is DeviceState.PLAYING, timeout=LONG_MS
    )
    bench.stop()
    assert not [text for text in told if "still moving" in text]
