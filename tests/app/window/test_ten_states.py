"""Header, badge and remedy in ten states of machines and simulators."""

import pytest
from PySide6.QtCore import Qt

from rotemina.app.motion.playback import PlaybackPhase
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.sim.trajectory import load_worn_effects, make_example

PANELS = ("control", "trajectory", "faults", "connection")
LONG_MS = 60_000
pytestmark = pytest.mark.slow


def click(qtbot, button):
    qtbot.waitUntil(button.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def wait_for_headword(qtbot, window, headword):
    qtbot.waitUntil(lambda: window._bar.phase.text().startswith(headword), timeout=LONG_MS)


def play(qtbot, window):
    bench = window.workbench
    bench.plan_trajectory("example", make_example(bench.robot))
    qtbot.waitUntil(lambda: bench.plan is not None and not bench.busy, timeout=LONG_MS)
    click(qtbot, window.panels["trajectory"].transport.play)
    qtbot.waitUntil(lambda: bench.session.snapshot().progress > 0.1, timeout=LONG_MS)


def pause(qtbot, window):
    play(qtbot, window)
    click(qtbot, window.panels["trajectory"].transport.play)
    playback = window.workbench.playback
    qtbot.waitUntil(lambda: playback.state.phase is PlaybackPhase.PAUSED, timeout=LONG_MS)


def move_during_a_pause(qtbot, window):
    pause(qtbot, window)
    qtbot.waitUntil(lambda: window.workbench.session.at_rest, timeout=LONG_MS)
    window.workbench.jog("x", 2.7e-3)
    qtbot.waitUntil(lambda: "since the pause" in window._bar.reason_label.text(), timeout=LONG_MS)
    qtbot.waitUntil(lambda: window.workbench.session.at_rest, timeout=LONG_MS)


def connect_boards(qtbot, window, *, homed=True):
    injection = window.panels["faults"].injection
    injection.homed.setChecked(homed)
    click(qtbot, injection.start_button)
    qtbot.waitUntil(lambda: len(injection.board.ports) == 2, timeout=LONG_MS)
    ports = dict(
        zip(("port", "second_port"), (port for port, _ in injection.board.ports), strict=True)
    )
    bench = window.workbench
    assert bench.use_driver(MC68HC11Driver, ports)
    qtbot.waitUntil(
        lambda: (
            bool(bench.session.snapshot().measured) and window._bar.badge.words == "VIRTUAL BOARDS"
        ),
        timeout=LONG_MS,
    )
    return injection.board


def home(qtbot, window):
    connect_boards(qtbot, window, homed=False)
    bench = window.workbench
    bench.clear_fault()
    qtbot.waitUntil(lambda: bench.session.snapshot().fault is None, timeout=LONG_MS)
    bench.home()
    qtbot.waitUntil(
        lambda: bench.session.snapshot().activity is DeviceState.HOMING, timeout=LONG_MS
    )


def report_a_fault(_, window):
    window.workbench.session.driver._fault = "the supply of the motors is off"


def cut_the_link(qtbot, window):
    connect_boards(qtbot, window)._process.kill()


def wear(qtbot, window):
    bench = window.workbench
    bench.session.service.set_effects(load_worn_effects(bench.robot))
    qtbot.waitUntil(lambda: window._bar.badge.port.startswith("worn"), timeout=LONG_MS)


SIMULATOR, BOARDS = "SIMULATOR", "VIRTUAL BOARDS"


@pytest.mark.parametrize(
    ("enter_state", "machine", "headword", "reason", "remedy", "tone"),
    [
        (lambda *_: None, SIMULATOR, "Ready", "every axis can be moved", "", "good"),
        (play, SIMULATOR, "Playing", "moves all axes", "", "busy"),
        (pause, SIMULATOR, "Paused at row", "Resume continues from here", "", "warning"),
        (
            lambda _, window: window.workbench.emergency_stop(),
            *(SIMULATOR, "Locked", "Release it to move", "Release", "danger"),
        ),
        (
            report_a_fault,
            *(SIMULATOR, "Fault", "clear the fault", "Clear fault", "danger"),
        ),
        (
            cut_the_link,
            *(BOARDS, "Link lost", "the machine may have moved", "Reconnect", "danger"),
        ),
        (
            move_during_a_pause,
            *(SIMULATOR, "Paused at row", "X moved 2.7 mm since the pause", "", "warning"),
        ),
        (home, BOARDS, "Homing", "limit switches of X, Y, Z", "", "busy"),
        (wear, SIMULATOR, "Ready", "every axis can be moved", "", "good"),
        (connect_boards, BOARDS, "Ready", "every axis can be moved", "", "good"),
    ],
    ids=(
        *("ready", "playing", "paused", "locked", "fault", "link-lost", "moved-during-a-pause"),
        *("homing", "worn-simulator", "virtual-boards"),
    ),
)
def test_the_header_shows_the_state_and_its_remedy(
    qtbot, window, enter_state, machine, headword, reason, remedy, tone
):
    bar = window._bar
    enter_state(qtbot, window)
    wait_for_headword(qtbot, window, headword)
    assert bar.badge.words == machine
    assert reason in bar.reason_label.text()
    assert bar.phase.property("tone") == tone
    assert (bar.remedy_button.text() if bar.remedy_button.isVisible() else "") == remedy
