"""The button Simulator of the first steps connects the simulator or says why it cannot."""

import threading

import pytest
from PySide6.QtCore import Qt

from rotemina.app.motion.state import ConnectionState
from rotemina.app.shell.window.machine_badge import DisplayedMachine
from rotemina.drivers.contract import ConnectionLostError, DeviceState
from rotemina.drivers.simulator import Simulator

LONG_MS = 30_000


class FakeBoard(Simulator):
    """A device that fails to open, or whose opening waits for an event."""

    name = "board"
    built_in_kind = None
    may_open = None

    def __init__(self, robot):
        super().__init__(robot)
        self.opening, self.closed = threading.Event(), threading.Event()

    def _open(self):
        if self.may_open is None:
            raise ConnectionLostError("board: nothing answers")
        self.opening.set()
        self.may_open.wait(LONG_MS / 1e3)
        super()._open()

    def _close(self):
        super()._close()
        self.closed.set()


@pytest.fixture
def press_simulator(qtbot):
    """Return a function that presses the button of the first steps."""

    def press(window):
        window.first_steps.offer()
        qtbot.waitUntil(window.first_steps.simulator_button.isEnabled, timeout=LONG_MS)
        qtbot.mouseClick(window.first_steps.simulator_button, Qt.MouseButton.LeftButton)

    return press


def is_simulated(window):
    session, bar = window.workbench.session, window._bar
    state = session.snapshot()
    return (
        type(session.driver) is Simulator
        and state.lock_reason is None
        and state.fault is None
        and bar.badge.machine is DisplayedMachine.SIMULATOR
        and window.first_steps._marks[0].text() == "✓"
    )


def test_the_simulator_can_be_chosen_after_a_device_has_failed(
    qtbot, make_robot_window, press_simulator
):
    window = make_robot_window(driver=FakeBoard)
    session, badge = window.workbench.session, window._bar.badge
    qtbot.waitUntil(
        lambda: session.snapshot().connection is ConnectionState.FAILED, timeout=LONG_MS
    )
    qtbot.waitUntil(lambda: badge.words == "MACHINE", timeout=LONG_MS)
    press_simulator(window)
    qtbot.waitUntil(lambda: is_simulated(window), timeout=LONG_MS)
    assert window._top_line.isHidden()
    driver = session.driver
    press_simulator(window)
    qtbot.waitUntil(lambda: is_simulated(window), timeout=LONG_MS)
    assert session.driver is driver


def test_the_simulator_can_be_chosen_while_a_device_hangs_in_open(
    qtbot, make_robot_window, press_simulator
):
    devices = []

    class HangingBoard(FakeBoard):
        may_open = threading.Event()

    window = make_robot_window(
        driver=lambda robot: devices.append(HangingBoard(robot)) or devices[-1]
    )
    session, badge = window.workbench.session, window._bar.badge
    session._max_release_s = 0.0
    try:
        qtbot.waitUntil(lambda: badge.words == "CONNECTING …", timeout=LONG_MS)
        assert devices[0].opening.wait(LONG_MS / 1e3)
        assert not window._top_line.isHidden()
        press_simulator(window)
        qtbot.waitUntil(lambda: is_simulated(window), timeout=LONG_MS)
    finally:
        HangingBoard.may_open.set()
        assert devices[0].closed.wait(LONG_MS / 1e3)
    qtbot.waitUntil(lambda: is_simulated(window), timeout=LONG_MS)


def test_moving_axes_are_given_as_the_reason(qtbot, make_robot_window, press_simulator):
    class Mover(Simulator):
        name, built_in_kind = "mover", None

    window = make_robot_window(driver=Mover)
    bench = window.workbench
    qtbot.waitUntil(lambda: bench.session.snapshot().lock_reason is None, timeout=LONG_MS)
    bench.go_to({"x": 0.05})
    qtbot.waitUntil(
        lambda: bench.session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS
    )
    press_simulator(window)
    assert "stop them before" in window.notices.notices()[-1].text
    assert type(bench.session.driver) is Mover
    bench.stop()
    qtbot.waitUntil(lambda: bench.session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    press_simulator(window)
    qtbot.waitUntil(lambda: is_simulated(window), timeout=LONG_MS)
