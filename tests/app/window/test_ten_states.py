"""Header, badge and remedy in ten states of machines and simulators."""

import pytest
from PySide6.QtCore import Qt

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


def check_header(qtbot, window, machine, headword, reason, remedy, tone):
    bar = window._bar
    qtbot.waitUntil(lambda: bar.phase.text().startswith(headword), timeout=LONG_MS)
    qtbot.waitUntil(lambda: reason in bar.reason_label.text(), timeout=LONG_MS)
    assert bar.badge.words == machine
    assert bar.phase.property("tone") == tone
    assert (bar.remedy_button.text() if bar.remedy_button.isVisible() else "") == remedy


SIMULATOR, BOARDS = "SIMULATOR", "VIRTUAL BOARDS"
READY = ("Ready", "every axis can be moved", "", "good")


def test_the_header_shows_the_states_of_a_playback(qtbot, window):
    bench, play = window.workbench, window.panels["trajectory"].transport.play
    session = bench.session
    check_header(qtbot, window, SIMULATOR, *READY)
    bench.plan_trajectory("example", make_example(bench.robot))
    qtbot.waitUntil(lambda: bench.plan is not None and not bench.busy, timeout=LONG_MS)
    click(qtbot, play)
    qtbot.waitUntil(lambda: session.snapshot().progress > 0.1, timeout=LONG_MS)
    check_header(qtbot, window, SIMULATOR, "Playing", "moves all axes", "", "busy")
    click(qtbot, play)
    reason = "Resume continues from here"
    check_header(qtbot, window, SIMULATOR, "Paused at row", reason, "", "warning")
    qtbot.waitUntil(lambda: session.at_rest, timeout=LONG_MS)
    bench.jog("x", 2.7e-3)
    reason = "X moved 2.7 mm since the pause"
    check_header(qtbot, window, SIMULATOR, "Paused at row", reason, "", "warning")
    bench.emergency_stop()
    check_header(qtbot, window, SIMULATOR, "Locked", "Release it to move", "Release", "danger")
    bench.release()
    session.driver._fault = "the supply of the motors is off"
    check_header(qtbot, window, SIMULATOR, "Fault", "clear the fault", "Clear fault", "danger")


def test_the_header_shows_the_states_of_a_worn_simulator_and_of_boards(qtbot, window):
    bench, injection = window.workbench, window.panels["faults"].injection
    session = bench.session
    session.service.set_effects(load_worn_effects(bench.robot))
    qtbot.waitUntil(lambda: window._bar.badge.port.startswith("worn"), timeout=LONG_MS)
    check_header(qtbot, window, SIMULATOR, *READY)
    injection.homed.setChecked(True)
    click(qtbot, injection.start_button)
    qtbot.waitUntil(lambda: len(injection.board.ports) == 2, timeout=LONG_MS)
    ports = (port for port, _ in injection.board.ports)
    assert bench.use_driver(MC68HC11Driver, dict(zip(("port", "second_port"), ports, strict=True)))
    qtbot.waitUntil(
        lambda: bool(session.snapshot().measured) and window._bar.badge.words == BOARDS,
        timeout=LONG_MS,
    )
    check_header(qtbot, window, BOARDS, *READY)
    bench.home()
    check_header(qtbot, window, BOARDS, "Homing", "limit switches of X, Y, Z", "", "busy")
    injection.board._process.kill()
    reason = "the machine may have moved"
    check_header(qtbot, window, BOARDS, "Link lost", reason, "Reconnect", "danger")
