"""State, stop buttons and badge in the header, and the status line."""

import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget, QFileDialog, QMessageBox, QWidget

from rotemina.app.motion.device import OPERATOR
from rotemina.app.panel import Panel
from rotemina.app.shell.window.header_row import LARGE_SIZES, SMALL_SIZES
from rotemina.app.shell.window.stop_controls import (
    MIN_RELEASE_DELAY_S,
    EmergencyButton,
    StopInputFilter,
)
from rotemina.app.workbench import Level
from rotemina.drivers.contract import DeviceState, MachineKind
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.sim.robot import AxisEffect
from rotemina.sim.trajectory import make_example

PANELS = ("gap",)

LONG_MS = 30_000


@pytest.fixture
def button(qtbot, window):
    """An emergency button with a clock that the test sets."""

    class Clock:
        now_s = 100.0

        def __call__(self):
            return self.now_s

    emergency_button = EmergencyButton(window.workbench, Clock())
    emergency_button.setParent(window.centralWidget())
    emergency_button.show()
    window.workbench.refreshed.connect(emergency_button.refresh)
    qtbot.waitUntil(emergency_button.isVisible, timeout=LONG_MS)
    return emergency_button


def click(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def test_the_phase_and_the_reason_are_shown(qtbot, window):
    bar, bench = window._bar, window.workbench
    qtbot.waitUntil(lambda: bar.phase.text() == "Ready", timeout=LONG_MS)
    bench.go_to({"x": 0.05})
    qtbot.waitUntil(lambda: bar.phase.text() == "Moving", timeout=LONG_MS)
    qtbot.waitUntil(lambda: bar.reason_label.text() == "Operator moves X", timeout=LONG_MS)
    assert bar.owner.text() == "Operator"
    bench.emergency_stop()
    qtbot.waitUntil(
        lambda: bar.reason_label.text().startswith("Locked by the operator"), timeout=LONG_MS
    )
    assert bar.phase.property("tone") == "danger"
    qtbot.waitUntil(lambda: bar.owner.text() == "No one is driving", timeout=LONG_MS)


def test_only_shift_escape_latches(qtbot, window, press_escape):
    session = window.workbench.session
    press_escape(window)
    assert session.snapshot().latch_reason is None
    session.go_to({"x": 0.05}, speeds={"x": 1e-4})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    dialog = QMessageBox(window)
    dialog.open()
    press_escape(dialog, Qt.KeyboardModifier.ShiftModifier)
    assert session.snapshot().latch_reason == "stop and lock"
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
    QTest.keyClick(screen, Qt.Key.Key_Escape)  # delivered to the window and its widgets in turn
    assert session.snapshot().latch_reason is None
    now_s[0] += pause_s
    QTest.keyClick(screen, Qt.Key.Key_Escape)
    assert (session.snapshot().latch_reason is not None) == locked


def test_a_held_escape_does_not_lock(window):
    press = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_Escape, Qt.KeyboardModifier.NoModifier)
    repeated = QKeyEvent(
        QEvent.Type.KeyPress, Qt.Key.Key_Escape, Qt.KeyboardModifier.NoModifier, "", True
    )
    for event in (press, repeated, repeated):
        QApplication.sendEvent(window.windowHandle(), event)
    assert window.workbench.session.snapshot().latch_reason is None
    assert window.workbench.session.stop_requested_s is not None


def test_a_second_press_of_stop_locks(qtbot, window):
    session = window.workbench.session
    click(qtbot, window.stop_button)
    assert session.snapshot().latch_reason is None
    click(qtbot, window.stop_button)
    assert session.snapshot().latch_reason == "stop and lock"


def test_escape_on_the_keypad_of_a_field_latches_too(window, press_escape):
    press_escape(window.panels["control"].rows["x"].target, Qt.KeyboardModifier.ShiftModifier)
    assert window.workbench.session.snapshot().latch_reason is not None


def test_the_button_latches_and_a_later_press_releases(qtbot, window, button):
    session = window.workbench.session
    click(qtbot, button)
    assert session.snapshot().latch_reason is not None
    assert button.isChecked()
    assert "release" in button.text()
    click(qtbot, button)  # too early to release
    assert session.snapshot().latch_reason is not None
    assert button.isChecked()
    button._clock.now_s += MIN_RELEASE_DELAY_S
    click(qtbot, button)
    assert session.snapshot().latch_reason is None
    assert not button.isChecked()


def test_an_external_latch_is_shown_and_not_released_by_the_first_press(qtbot, window, button):
    window.workbench.emergency_stop()
    qtbot.waitUntil(button.isChecked, timeout=LONG_MS)
    click(qtbot, button)
    assert window.workbench.session.snapshot().latch_reason is not None
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


def test_the_status_line_shows_the_driver_and_the_age_of_its_state(qtbot, window):
    status = window._status
    qtbot.waitUntil(lambda: "simulator: Ready" in status.text(), timeout=LONG_MS)
    assert "old" in status.text()
    window.workbench.stop()
    qtbot.waitUntil(lambda: "last stop" in status.text(), timeout=LONG_MS)
    window.workbench.disconnect_device()
    qtbot.waitUntil(lambda: "simulator: Disconnected" in status.text(), timeout=LONG_MS)


def test_escape_stops_under_a_modal_dialog_and_a_file_dialog(qtbot, window, press_escape, tmp_path):
    session = window.workbench.session
    qtbot.waitUntil(lambda: session.snapshot().position_known, timeout=LONG_MS)
    for dialog in (QMessageBox(window), QFileDialog(window, "Open", str(tmp_path))):
        dialog.open()
        assert dialog.findChildren(QWidget), "the keys of a native dialog do not reach the program"
        session.go_to({"x": 0.05}, speeds={"x": 1e-4})
        qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
        press_escape(dialog)
        qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
        assert session.snapshot().stop.by == OPERATOR
        session.stop()
        dialog.close()


class PanelWithDialog(Panel):
    """A panel whose constructor opens a dialog, in which Esc is pressed."""

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
        panels.panel_types[name] = PanelWithDialog
        window.docks[name] = QDockWidget(window)
        panels.make(name)
        qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
        assert session.snapshot().stop.by == OPERATOR


def start_moving(qtbot, session):
    """Set an axis in motion, and wait for it."""
    qtbot.waitUntil(lambda: session.snapshot().position_known, timeout=LONG_MS)
    session.go_to({"x": 0.05}, speeds={"x": 1e-4})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)


def test_escape_stops_in_a_menu_that_a_key_has_just_opened(qtbot, window):
    session, menu = window.workbench.session, window.menuBar().actions()[0].menu()
    start_moving(qtbot, session)
    no_modifier = Qt.KeyboardModifier.NoModifier
    event_types = QEvent.Type.KeyPress, QEvent.Type.KeyRelease
    key_events = [
        QKeyEvent(event_type, Qt.Key.Key_F, no_modifier, "f") for event_type in event_types
    ]
    QApplication.sendEvent(window.windowHandle(), key_events[0])
    menu.popup(window.mapToGlobal(QPoint(0, 0)))  # as the key does
    # No event loop has run since, so the window of the menu is not known yet.
    escape = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_Escape, no_modifier)
    QApplication.sendEvent(menu.windowHandle(), escape)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    assert session.snapshot().stop.by == OPERATOR
    menu.close()


def test_escape_stops_in_a_window_without_focus(qtbot, window):
    session = window.workbench.session
    start_moving(qtbot, session)
    other_window = QWidget()
    qtbot.addWidget(other_window)
    other_window.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
    other_window.show()
    QTest.qWait(250)  # longer than the period of the search for new windows
    QTest.keyClick(other_window.windowHandle(), Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    assert session.snapshot().stop.by == OPERATOR


def test_a_press_locks_if_the_shown_lock_has_already_been_released(qtbot, window):
    session, button = window.workbench.session, window.emergency_button
    session.emergency_stop("a stick")
    button.refresh(session.snapshot())
    button._latched_at_s -= 10.0  # long ago: a press would release it
    session.release()
    assert button.isChecked()  # no frame has been drawn since
    click(qtbot, button)
    assert session.snapshot().latch_reason == "stop and lock"


class CountingFilter(StopInputFilter):
    """A stop filter that counts its calls."""

    call_count = 0

    def eventFilter(self, watched, event):  # noqa: N802 (Qt's name)
        self.call_count += 1
        return super().eventFilter(watched, event)


def test_events_between_widgets_bypass_the_stop_filter(window):
    buttons = window.stop_button, window.emergency_button
    watch = CountingFilter(window.workbench, *buttons, window)
    watch.start()
    QApplication.sendEvent(window.windowHandle(), QEvent(QEvent.Type.User))
    assert watch.call_count == 1
    QApplication.sendEvent(window.stop_button, QEvent(QEvent.Type.User))
    assert watch.call_count == 1
    watch.close()


@pytest.mark.parametrize("name", ["gap", "no such panel"])
def test_escape_stops_after_a_panel_is_made_or_fails(qtbot, window, press_escape, name):
    session = window.workbench.session
    qtbot.waitUntil(lambda: session.snapshot().position_known, timeout=LONG_MS)
    window.panels.panel_types["no such panel"] = (
        Panel.__new__
    )  # not callable like this, so it fails
    window.panels.make(name)
    session.go_to({"x": 0.05}, speeds={"x": 1e-4})
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS)
    press_escape(window)
    qtbot.waitUntil(lambda: session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)


def test_no_dialog_is_native(window):
    assert QApplication.testAttribute(Qt.ApplicationAttribute.AA_DontUseNativeDialogs)


def test_who_stopped_is_shown_until_something_moves(qtbot, window):
    bar, session = window._bar, window.workbench.session
    qtbot.waitUntil(lambda: bar.phase.text() == "Ready", timeout=LONG_MS)
    window.workbench.stop()
    stop_text = f"Stopped by the operator at {session.snapshot().stop.at:%H:%M:%S}"
    qtbot.waitUntil(lambda: bar.reason_label.text().startswith(stop_text), timeout=LONG_MS)
    session.stop("the window does not respond")
    qtbot.waitUntil(
        lambda: bar.reason_label.text().startswith("Stopped by the program"), timeout=LONG_MS
    )
    assert ": the window does not respond." in bar.reason_label.text()
    window.workbench.jog("x", 1e-4)
    at_rest = "At rest; every axis can be moved."
    qtbot.waitUntil(lambda: bar.reason_label.text() == at_rest, timeout=LONG_MS)
    assert bar.phase.text() == "Ready"


def test_a_stop_is_not_shown_as_ready_and_a_released_lock_is_forgotten(qtbot, window):
    bar, bench = window._bar, window.workbench
    qtbot.waitUntil(lambda: bar.phase.text() == "Ready", timeout=LONG_MS)
    assert bar.reason_label.text() == "At rest; every axis can be moved."
    bench.stop()
    qtbot.waitUntil(lambda: bar.phase.text() == "Stopped", timeout=LONG_MS)
    assert bar.reason_label.text().startswith("Stopped by the operator at ")
    bench.emergency_stop()
    qtbot.waitUntil(lambda: bar.phase.text() == "Locked", timeout=LONG_MS)
    assert bar.remedy_button.text() == "Release"
    assert not bar.remedy_button.isEnabled()  # against an accidental second press
    qtbot.waitUntil(bar.remedy_button.isEnabled, timeout=LONG_MS)
    click(qtbot, bar.remedy_button)
    qtbot.waitUntil(lambda: bar.phase.text() == "Ready", timeout=LONG_MS)
    assert bar.reason_label.text() == "At rest; every axis can be moved."
    assert not bar.remedy_button.isVisible()


def test_the_header_has_the_sizes_of_both_screens(window):
    bar = window._bar
    for width, height, sizes in ((1920, 1080, LARGE_SIZES), (1280, 800, SMALL_SIZES)):
        window.resize(width, height)
        QApplication.processEvents()
        assert bar.height() == pytest.approx(sizes.height, abs=2)
        parts = (bar.badge, bar.emergency, bar.stop)
        for part, size in zip(parts, (sizes.badge, sizes.lock, sizes.stop), strict=True):
            assert part.size() == size
            assert part.fontMetrics().height() <= part.height()
        assert bar.stop.width() * 2 == pytest.approx(bar.emergency.width() * 3, rel=0.01)
        ordered_parts = [bar.badge, bar.state, bar.model, bar.events, bar.emergency, bar.stop]
        lefts = [widget.mapTo(window, QPoint()).x() for widget in ordered_parts]
        rights = [x + widget.width() for x, widget in zip(lefts, ordered_parts, strict=True)]
        assert all(right <= left for right, left in zip(rights, lefts[1:], strict=False))
        assert rights[-1] <= width


def test_a_machine_that_may_be_real_is_shown_as_one(window, monkeypatch):
    bar, session = window._bar, window.workbench.session
    assert window.windowTitle().startswith("RoTeMiNa – SIMULATOR nominal – ")
    for port, kind, machine in (
        ("/dev/pts/7", None, "MACHINE"),
        ("/dev/pts/7", MachineKind.VIRTUAL, "VIRTUAL BOARDS"),
        ("/dev/ttyUSB0", MachineKind.REAL, "MACHINE"),
        ("socket://h:1", MachineKind.VIRTUAL, "VIRTUAL BOARDS"),
    ):
        boards = MC68HC11Driver(window.workbench.robot, {"port": port})
        boards._machine_kind = kind  # as identified when it was opened
        with monkeypatch.context() as patch:
            patch.setattr(type(session), "driver", boards)
            bar.refresh(session.snapshot())
        assert window.windowTitle().startswith(f"RoTeMiNa – {machine} {port} – ")
        assert window._top_line.isVisible() is (machine == "MACHINE")
        assert window._top_line.geometry().getRect() == (0, 0, window.width(), 4)
        assert not bar.badge.grab().toImage().isNull()


def test_warnings_are_counted_until_the_log_is_opened(qtbot, window):
    bar = window._bar
    window.workbench.notify(Level.WARNING, "something")
    window.workbench.notify(Level.INFO, "a word")
    assert bar.events.text() == "Warnings 1"
    click(qtbot, bar.events)
    assert window.log_page.isVisible()
    assert bar.events.text() == "Warnings 0"


def test_play_waits_until_switched_effects_have_settled(qtbot, window):
    bench = window.workbench
    with qtbot.waitSignal(bench.plan_changed, timeout=LONG_MS):
        bench.plan_trajectory("example", make_example(bench.robot))
    notices = []
    bench.notice_posted.connect(lambda _, text: notices.append(text))
    bench.session.service.set_effects(
        [AxisEffect(axis="zn", id="hysteresis", parameters={"width": 6e-6})]
    )
    bench.play()  # before the effects are active
    qtbot.waitUntil(
        lambda: bench.session.snapshot().activity is DeviceState.PLAYING, timeout=LONG_MS
    )
    bench.stop()
    assert not [text for text in notices if "still moving" in text]
