"""The button Simulator of the first steps connects the simulator, or says why not."""

import threading

import pytest
from PySide6.QtCore import Qt

from rotemina.app.motion.state import Connection
from rotemina.app.shell.machine_badge import Machine
from rotemina.drivers.errors import ConnectionLostError
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator

LONG_MS = 30_000


class Board(Simulator):
    """A device that cannot be opened, or takes its time for that."""

    name = "board"
    built_in_kind = None
    free = None

    def __init__(self, robot):
        super().__init__(robot)
        self.hangs, self.left = threading.Event(), threading.Event()

    def _open(self):
        if self.free is None:
            raise ConnectionLostError("board: nothing answers")
        self.hangs.set()
        self.free.wait(LONG_MS / 1e3)
        super()._open()

    def _close(self):
        super()._close()
        self.left.set()


@pytest.fixture
def choose(qtbot):
    """Press the button of a window's card."""

    def choose(window):
        window.first_steps.offer()
        qtbot.waitUntil(window.first_steps.stay.isEnabled, timeout=LONG_MS)
        qtbot.mouseClick(window.first_steps.stay, Qt.MouseButton.LeftButton)

    return choose


def is_simulated(window):
    session, bar = window.workbench.session, window._bar
    state = session.snapshot()
    return (
        type(session.driver) is Simulator
        and state.locked is None
        and state.fault is None
        and bar.badge.machine is Machine.SIMULATOR
        and window.first_steps._marks[0].text() == "✓"
    )


def test_after_a_device_has_failed(qtbot, make_robot_window, choose):
    window = make_robot_window(driver=Board)
    badge = window._bar.badge
    session = window.workbench.session
    qtbot.waitUntil(
        lambda: session.snapshot().connection is Connection.FAILED and badge.words == "MACHINE",
        timeout=LONG_MS,
    )
    choose(window)
    qtbot.waitUntil(lambda: is_simulated(window), timeout=LONG_MS)
    assert window._top_line.isHidden()


def test_while_the_opening_of_a_device_hangs(qtbot, make_robot_window, choose):
    free = threading.Event()
    made = []

    class Hanging(Board):
        pass

    Hanging.free = free
    window = make_robot_window(driver=lambda robot: made.append(Hanging(robot)) or made[-1])
    session, badge = window.workbench.session, window._bar.badge
    session._max_release_s = 0.0
    try:
        qtbot.waitUntil(lambda: badge.words == "CONNECTING …", timeout=LONG_MS)
        assert made[0].hangs.wait(LONG_MS / 1e3)
        assert not window._top_line.isHidden()
        choose(window)
        qtbot.waitUntil(lambda: is_simulated(window), timeout=LONG_MS)
    finally:
        free.set()
        assert made[0].left.wait(LONG_MS / 1e3)
    qtbot.waitUntil(lambda: is_simulated(window), timeout=LONG_MS)


def test_moving_axes_are_a_reason_that_is_told(qtbot, make_robot_window, choose):
    class Mover(Simulator):
        name, built_in_kind = "mover", None

    window = make_robot_window(driver=Mover)
    bench = window.workbench
    qtbot.waitUntil(lambda: bench.session.snapshot().locked is None, timeout=LONG_MS)
    bench.go_to({"x": 0.05})
    qtbot.waitUntil(
        lambda: bench.session.snapshot().activity is DeviceState.MOVING, timeout=LONG_MS
    )
    choose(window)
    assert "stop them before" in window.notices.notices()[-1].text
    assert type(bench.session.driver) is Mover
    bench.stop()
    qtbot.waitUntil(lambda: bench.session.snapshot().activity is DeviceState.IDLE, timeout=LONG_MS)
    choose(window)
    qtbot.waitUntil(lambda: is_simulated(window), timeout=LONG_MS)


def test_a_simulator_in_use_stays(qtbot, window, choose):
    driver = window.workbench.session.driver
    choose(window)
    qtbot.waitUntil(lambda: is_simulated(window), timeout=LONG_MS)
    assert window.workbench.session.driver is driver
