"""The badge shows which machine the device identified itself as, even after a lost connection."""

import subprocess
import sys
import threading
from contextlib import contextmanager
from types import SimpleNamespace

import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import ConnectionState
from rotemina.app.shell.window.machine_badge import (
    MAYBE_REAL,
    DisplayedMachine,
    MachineBadge,
    identify_machine,
    make_window_title,
)
from rotemina.app.widgets.style import THEMES
from rotemina.drivers.contract import MachineKind
from rotemina.drivers.gcode.driver import GcodeStage
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

WAIT_S = 30.0
ROBOT = load_robot("rotemina")


class Device(Simulator):
    """A connected device that identifies itself as the kind that the test sets."""

    name = "device"
    built_in_kind = None
    kind = MachineKind.REAL

    def _identify(self):
        return self.kind


class VirtualDevice(Device):
    kind = MachineKind.VIRTUAL


@pytest.mark.parametrize(
    ("driver", "opened", "connection", "machine"),
    [
        (Simulator, False, ConnectionState.CONNECTING, DisplayedMachine.SIMULATOR),
        (Simulator, True, ConnectionState.FAILED, DisplayedMachine.SIMULATOR),
        (Device, False, ConnectionState.DISCONNECTED, DisplayedMachine.MACHINE),
        (Device, False, ConnectionState.CONNECTING, DisplayedMachine.UNIDENTIFIED),
        (Device, False, ConnectionState.FAILED, DisplayedMachine.MACHINE),
        (Device, True, ConnectionState.CONNECTING, DisplayedMachine.MACHINE),
        (VirtualDevice, False, ConnectionState.CONNECTING, DisplayedMachine.UNIDENTIFIED),
        (VirtualDevice, True, ConnectionState.FAILED, DisplayedMachine.VIRTUAL_BOARDS),
        (VirtualDevice, True, ConnectionState.CONNECTING, DisplayedMachine.VIRTUAL_BOARDS),
    ],
)
def test_the_machine_is_what_the_device_identified_as(driver, opened, connection, machine):
    device = driver(ROBOT)
    if opened:
        device.open()
        device.close()
    assert identify_machine(device, connection) is machine


def test_a_port_path_does_not_identify_the_machine():
    boards = MC68HC11Driver(ROBOT, {"port": "/dev/pts/3", "second_port": "/dev/pts/4"})
    assert identify_machine(boards, ConnectionState.FAILED) is DisplayedMachine.MACHINE


def test_an_unidentified_device_looks_like_a_real_machine(qtbot):
    session = MotionSession(Device(ROBOT))
    badge = MachineBadge(SimpleNamespace(session=session, theme=THEMES["dark"]))
    qtbot.addWidget(badge)
    session.connect()
    refreshes = []
    session.subscribe(lambda _: refreshes.append((badge.refresh(session.snapshot()), badge.words)))
    session.run_once()
    assert refreshes == [(True, "CONNECTING …"), (True, "MACHINE")]
    assert {DisplayedMachine.UNIDENTIFIED, DisplayedMachine.MACHINE} == set(MAYBE_REAL)
    badge.resize(badge.sizeHint())
    real_colour = badge.grab().toImage().pixelColor(60, 50)
    session.use_driver(VirtualDevice(ROBOT))
    badge.refresh(session.snapshot())
    assert make_window_title(badge, "r") == "RoTeMiNa – CONNECTING … device – r"
    assert badge.grab().toImage().pixelColor(60, 50) == real_colour
    session.run_once()
    changes = [words for is_changed, words in refreshes[2:] if is_changed]
    assert changes == ["VIRTUAL BOARDS"]
    assert badge.grab().toImage().pixelColor(60, 50) != real_colour


@contextmanager
def serve_device(*options):
    """Run a command that serves a device; yield its ports and its process."""
    command = [sys.executable, "-m", "rotemina.app.cli.main", *options]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        try:
            line = process.stdout.readline()
            while not line.startswith("listening on "):
                assert line, "the process has ended"
                line = process.stdout.readline()
            yield line.split()[2].rstrip(":"), process
        finally:
            process.kill()


@pytest.mark.parametrize(
    ("driver", "robot", "options"),
    [
        (MC68HC11Driver, "picma", ("board", "--position-known", "--tcp", "127.0.0.1:0")),
        (GcodeStage, "xyz", ("stage",)),
    ],
    ids=["boards over TCP", "stage on a pseudo-terminal"],
)
def test_emulated_devices_are_shown_as_virtual_even_after_a_connection_loss(driver, robot, options):
    with serve_device(*options, "--robot", robot) as (port, process):
        assert port.startswith("socket://") is ("--tcp" in options)
        device = driver(load_robot(robot), {"port": port})
        session = MotionSession(device)
        connection_events = {state: threading.Event() for state in ConnectionState}
        session.subscribe(lambda _: connection_events[session.reported.connection].set())
        session.start()
        try:
            assert connection_events[ConnectionState.CONNECTED].wait(WAIT_S), session.snapshot()
            connected_as = identify_machine(device, session.snapshot().connection)
            process.kill()
            assert connection_events[ConnectionState.FAILED].wait(WAIT_S)
            lost_as = identify_machine(device, session.snapshot().connection)
        finally:
            session.close()
    assert connected_as is lost_as is DisplayedMachine.VIRTUAL_BOARDS


def test_a_worn_simulator_is_not_mistaken_for_the_nominal_one(qtbot):
    session = MotionSession(Simulator(ROBOT))
    badge = MachineBadge(SimpleNamespace(session=session, theme=THEMES["dark"]))
    qtbot.addWidget(badge)
    assert badge.port == "nominal"
    session.driver._effects = (
        AxisEffect(axis="x", id="backlash"),
        AxisEffect(axis="y", id="backlash", enabled=False),
        AxisEffect(axis="zn", id="creep"),
    )
    assert badge.refresh(session.snapshot())
    assert badge.port == "worn: X, Z nano"
    assert "worn" in badge.accessibleName()
