"""Teleoperation: how soon a stick's motion is on the wire, and what switching leaves of a motion.

``make bench`` runs it on a machine that does nothing else. The boards are a process of their own at
true baud; a stick is a fake below hidapi. A change is timed from its report to the last byte of the
speed that follows from it, by the line's own baud rate: the limits are 10 ms at the median and
20 ms at the 99th percentile, at 200 Hz.
"""

import struct
import subprocess
import sys
import time
from collections import deque
from contextlib import contextmanager

import numpy as np
import pytest

from rotemina.app.motion.operation import Operation
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Phase
from rotemina.app.motion.teleoperation.intent import Action, Intent
from rotemina.app.motion.teleoperation.scales import LawKind
from rotemina.app.motion.teleoperation.teleoperation_loop import Teleoperator
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.inputs.hid.hid_discovery import HidSource
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.mc68hc11.framing import Decoder
from rotemina.drivers.mc68hc11.host_messages import MoveVelocity
from rotemina.drivers.serial_port import open_port
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
CHANGES = 400
BAUD, BITS_A_BYTE = 125_000, 10
TICK_S = 0.005
DESCRIPTOR = bytes.fromhex(
    "05 01 09 04 A1 01 16 01 80 26 FF 7F 75 10 95 03 09 30 09 31 09 35 81 02"
    "05 09 19 01 29 02 15 00 25 01 75 01 95 02 81 02 75 06 95 01 81 03 C0"
)
QUICK = {"CHANGES": 10}


class Stick:
    """hidapi's module and its only device in one; ``push`` is what a hand does."""

    def __init__(self):
        self.waiting = deque()
        self.push(0.0)

    def enumerate(self):
        about = {"vendor_id": 1, "product_id": 1, "usage_page": 1, "usage": 4}
        names = {"manufacturer_string": "", "product_string": "Stick", "serial_number": "1"}
        return [{**about, **names, "path": b"stick", "interface_number": 0}]

    def device(self):
        return self

    def open_path(self, path):
        pass

    def set_nonblocking(self, on):
        return 0

    def get_report_descriptor(self, max_length=4096):
        return list(DESCRIPTOR)

    def read(self, max_length):
        return list(self.waiting.popleft()) if self.waiting else []

    def error(self):
        return ""

    def close(self):
        pass

    def push(self, x):
        self.waiting.append(struct.pack("<3hB", round(32767 * x), 0, 0, 0))


class Wire:
    """A port that notes speeds of the first axis, and when their last byte is out."""

    def __init__(self, url, baud):
        self._port = open_port(url, baud)
        self._decoder = Decoder(of_board=True)
        self.speeds = []

    def write(self, data):
        now_s = time.monotonic()
        self._port.write(data)
        for frame in self._decoder.feed(data):
            if frame.type == MoveVelocity.TYPE:
                axis, speed, _ = MoveVelocity.LAYOUT.unpack(frame.payload)
                if axis == 0:
                    self.speeds.append((now_s + len(data) * BITS_A_BYTE / BAUD, speed))

    def __getattr__(self, name):
        return getattr(self._port, name)


@contextmanager
def boards(clock):
    command = [sys.executable, "-m", "rotemina.app.cli.main", "board", "--position-known"]
    command += ["--clock", clock]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            yield [process.stdout.readline().split()[2].rstrip(":") for _ in range(2)]
        finally:
            process.terminate()


def until(condition, limit_s=20.0):
    end_s = time.monotonic() + limit_s
    while not condition():
        assert time.monotonic() < end_s
        time.sleep(2e-4)


@pytest.mark.parametrize("clock", ["4", "2"])  # MHz, E of the chip
def test_from_stick_to_wire(tmp_path, clock):
    stick, wires = Stick(), []

    def opened(url, baud):
        wires.append(Wire(url, baud))
        return wires[-1]

    with boards(clock) as ports:
        driver = MC68HC11(ROBOT, {"port": ports[0], "second_port": ports[1]}, open_port=opened)
        session = MotionSession(driver)
        sources = {"hid": HidSource(load=lambda: stick)}
        operation = Operation(session, tmp_path / "config", tmp_path / "data", sources=sources)
        session.start()
        until(lambda: session.snapshot().phase is Phase.READY)
        operation.start()
        until(lambda: "x" in operation.intent.deflections)
        rng, waits = np.random.default_rng(1), []
        # Up and down as a hand does it: a stick that leaps is not trusted.
        level, step, speeds = 0.3, 0.08, wires[0].speeds
        stick.push(level)
        until(lambda: bool(speeds))
        for _ in range(CHANGES):
            time.sleep(rng.uniform(0.03, 0.06))
            step = np.copysign(0.08, step if 0.2 < level + step < 0.9 else -step)
            level += step
            seen, before = len(speeds), speeds[-1][1]
            least = step * 0.25 * 1e4  # steps a second: a quarter of the change to come
            begin_s = time.monotonic()
            stick.push(level)

            def told(since=seen, before=before, least=least):
                new = list(speeds[since:])
                return [at for at, speed in new if (speed - before) / least > 1.0]

            until(lambda: len(told()) > 0)
            waits.append(told()[0] - begin_s)
        stick.push(0.0)
        operation.close()
        session.close()
    waits = 1e3 * np.array(waits)
    print(
        f"\nstick to wire, {clock} MHz, {CHANGES} changes, ms: median {np.median(waits):.1f} "
        f"(limit 10), 99 % {np.percentile(waits, 99):.1f} (20), worst {waits.max():.1f}"
    )


@pytest.mark.parametrize(
    "sticks", [{"x": 0.0, "y": 0.0, "z": 0.0}, {"x": 0.7, "y": -0.5, "z": 0.6}]
)
def test_what_switching_leaves(sticks):
    """Switch through all modes and laws on the simulator; print the greatest step of a command."""
    clock = VirtualClock(1.0)
    session = MotionSession(Simulator(ROBOT, clock=clock))
    session.connect()
    session.run_once()
    teleoperator, samples = Teleoperator(session), []
    session.tap(lambda portion, _: samples.append(portion))
    rest = dict.fromkeys(sticks, 0.0)
    moves = []

    def run(seconds, deflections, *pressed):
        for number in range(max(1, round(seconds / TICK_S))):
            clock.advance(TICK_S)
            session.run_once()
            actions = frozenset(pressed if number == 0 else ())
            intent = Intent(clock(), deflections, actions, frozenset(), "bench")
            begin_s = time.perf_counter()
            teleoperator.step(intent, clock())
            moves.append(time.perf_counter() - begin_s)

    for law in LawKind:
        teleoperator.use_law(law)
        for _ in teleoperator.modes.names:
            run(0.2, rest)
            run(0.3, sticks)
            run(0.2, sticks, Action.STAGE)
            run(0.2, sticks, Action.LAW)
    commands = np.concatenate([portion.command for portion in samples])
    bends = np.abs(np.diff(commands, n=2, axis=0)).max(axis=0)
    held = ", ".join(f"{name} {deflection:g}" for name, deflection in sticks.items())
    steps = dict(zip(ROBOT.axes, bends, strict=True))
    shown = ", ".join(f"{name} {step:.3g}" for name, step in steps.items())
    print(
        f"\nsticks at {held}: loop step {1e3 * np.median(moves):.2f} ms; greatest second "
        "difference of a command while switching, m or rad (limit: greatest acceleration × "
        f"(1 ms)²): {shown}"
    )
    for name, step in steps.items():
        assert step <= ROBOT.axes[name].max_acceleration * 1e-6 * (1.0 + 1e-6), name
