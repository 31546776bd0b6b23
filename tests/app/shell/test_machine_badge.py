"""The badge says which machine is driven, as the device itself has said, also after its loss."""

import subprocess
import sys
import threading
from contextlib import contextmanager
from types import SimpleNamespace

import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection
from rotemina.app.shell.machine_badge import (
    MAYBE_REAL,
    Machine,
    MachineBadge,
    machine_of,
    window_title,
)
from rotemina.app.shell.theme import THEMES
from rotemina.drivers.driver import MachineKind
from rotemina.drivers.gcode.driver import GcodeStage
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

WAIT_S = 30.0
ROBOT = load_robot("rotemina")


class Device(Simulator):
    """A device at the end of a line, which says what the test wants."""

    name = "device"
    built_in_kind = None
    kind = MachineKind.REAL

    def _identify(self):
        return self.kind


class Virtual(Device):
    kind = MachineKind.VIRTUAL


@pytest.mark.parametrize(
    ("driver", "opened", "connection", "machine"),
    [
        (Simulator, False, Connection.CONNECTING, Machine.SIMULATOR),
        (Simulator, True, Connection.FAILED, Machine.SIMULATOR),
        (Device, False, Connection.DISCONNECTED, Machine.MACHINE),
        (Device, False, Connection.CONNECTING, Machine.UNIDENTIFIED),
        (Device, False, Connection.FAILED, Machine.MACHINE),
        (Device, True, Connection.CONNECTED, Machine.MACHINE),
        (Device, True, Connection.CONNECTING, Machine.MACHINE),
        (Virtual, False, Connection.CONNECTING, Machine.UNIDENTIFIED),
        (Virtual, True, Connection.CONNECTED, Machine.VIRTUAL_BOARDS),
        (Virtual, True, Connection.FAILED, Machine.VIRTUAL_BOARDS),
        (Virtual, True, Connection.DISCONNECTED, Machine.VIRTUAL_BOARDS),
        (Virtual, True, Connection.CONNECTING, Machine.VIRTUAL_BOARDS),
    ],
)
def test_the_machine_is_what_the_device_said_it_is(driver, opened, connection, machine):
    made = driver(ROBOT)
    if opened:
        made.open()
        made.close()
    assert machine_of(made, connection) is machine


def test_a_path_of_a_port_says_nothing():
    made = MC68HC11(ROBOT, {"port": "/dev/pts/3", "second_port": "/dev/pts/4"})
    assert machine_of(made, Connection.FAILED) is Machine.MACHINE


def test_what_has_not_said_what_it_is_looks_like_a_real_machine(qtbot):
    session = MotionSession(Device(ROBOT))
    badge = MachineBadge(SimpleNamespace(session=session, theme=THEMES["dark"]))
    qtbot.addWidget(badge)
    session.connect()
    seen = []
    session.subscribe(lambda _: seen.append((badge.refresh(session.snapshot()), badge.words)))
    session.run_once()
    assert seen == [(True, "CONNECTING …"), (True, "MACHINE")]
    assert {Machine.UNIDENTIFIED, Machine.MACHINE} == set(MAYBE_REAL)
    badge.resize(badge.sizeHint())
    real = badge.grab().toImage().pixelColor(60, 50)
    session.use(Virtual(ROBOT))
    badge.refresh(session.snapshot())
    assert window_title(badge, "r") == "RoTeMiNa – CONNECTING … device – r"
    assert badge.grab().toImage().pixelColor(60, 50) == real
    session.run_once()
    changes = [words for is_changed, words in seen[2:] if is_changed]
    assert changes == ["VIRTUAL BOARDS"]
    assert badge.grab().toImage().pixelColor(60, 50) != real


# --- through the real drivers, against what the project ships -------------------------------------


@contextmanager
def served(*options):
    """Run a command that serves a device; give its ports and its process."""
    command = [sys.executable, "-m", "rotemina.app.cli.main", *options]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        try:
            line = process.stdout.readline()
            while not line.startswith("listening on "):
                assert line, "it has ended"
                line = process.stdout.readline()
            yield line.split()[2].rstrip(":"), process
        finally:
            process.kill()


@pytest.mark.parametrize(
    ("driver", "robot", "options"),
    [
        (MC68HC11, "picma", ("board", "--position-known")),
        (MC68HC11, "picma", ("board", "--position-known", "--tcp", "127.0.0.1:0")),
        (GcodeStage, "xyz", ("stage",)),
    ],
    ids=["boards on a pseudo-terminal", "boards over TCP", "stage on a pseudo-terminal"],
)
def test_what_the_project_emulates_says_so_and_stays_so_when_it_is_lost(driver, robot, options):
    with served(*options, "--robot", robot) as (port, process):
        assert port.startswith("socket://") is ("--tcp" in options)
        made = driver(load_robot(robot), {"port": port})
        session = MotionSession(made)
        news = {each: threading.Event() for each in Connection}
        session.subscribe(lambda _: news[session.reported.connection].set())
        session.start()
        try:
            assert news[Connection.CONNECTED].wait(WAIT_S), session.snapshot()
            seen = machine_of(made, session.snapshot().connection)
            process.kill()
            assert news[Connection.FAILED].wait(WAIT_S)
            lost = machine_of(made, session.snapshot().connection)
        finally:
            session.close()
    assert (seen, lost) == (Machine.VIRTUAL_BOARDS, Machine.VIRTUAL_BOARDS)


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
