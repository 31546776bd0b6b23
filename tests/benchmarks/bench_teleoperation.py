"""Teleoperation: latency from a stick to the wire.

``make bench`` runs it on an idle machine. The boards are a separate process at true baud; a stick
is a fake below hidapi. The latency is measured from a report of the stick to the last byte of the
resulting speed command, which the baud rate determines. Limits: 10 ms at the median and 20 ms at
the 99th percentile, at 200 Hz.
"""

import struct
import subprocess
import sys
import time
from collections import deque
from contextlib import contextmanager

import numpy as np
import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionPhase
from rotemina.app.operation import OperatorControl
from rotemina.drivers.inputs import HidSource
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.mc68hc11.protocol import FrameDecoder, MoveVelocity
from rotemina.drivers.serial_lines import open_port
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
CHANGES = 400
BAUD, BITS_A_BYTE = 125_000, 10
DESCRIPTOR = bytes.fromhex(
    "05 01 09 04 A1 01 16 01 80 26 FF 7F 75 10 95 03 09 30 09 31 09 35 81 02"
    "05 09 19 01 29 02 15 00 25 01 75 01 95 02 81 02 75 06 95 01 81 03 C0"
)
QUICK = {"CHANGES": 10}


class FakeStick:
    """Fake of the hidapi module with a single device; ``push`` moves the stick."""

    def __init__(self):
        self.reports = deque()
        self.push(0.0)

    def enumerate(self):
        numbers = {"vendor_id": 1, "product_id": 1, "usage_page": 1, "usage": 4}
        names = {"manufacturer_string": "", "product_string": "Stick", "serial_number": "1"}
        return [{**numbers, **names, "path": b"stick", "interface_number": 0}]

    def device(self):
        return self

    def open_path(self, path):
        pass

    def set_nonblocking(self, on):
        return 0

    def get_report_descriptor(self, max_length=4096):
        return list(DESCRIPTOR)

    def read(self, max_length):
        return list(self.reports.popleft()) if self.reports else []

    def error(self):
        return ""

    def close(self):
        pass

    def push(self, x):
        self.reports.append(struct.pack("<3hB", round(32767 * x), 0, 0, 0))


class RecordingPort:
    """A port that records speeds of the first axis, and the times of their last bytes."""

    def __init__(self, url, baud):
        self._port = open_port(url, baud)
        self._decoder = FrameDecoder(is_board=True)
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
def run_boards(clock):
    command = [sys.executable, "-m", "rotemina.app.cli.main", "board", "--position-known"]
    command += ["--clock", clock]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            yield [process.stdout.readline().split()[2].rstrip(":") for _ in range(2)]
        finally:
            process.terminate()


def wait_until(condition, limit_s=20.0):
    end_s = time.monotonic() + limit_s
    while not condition():
        assert time.monotonic() < end_s
        time.sleep(2e-4)


# E clock of the chip, MHz.
@pytest.mark.parametrize("clock", ["4", "2"])
def test_from_stick_to_wire(tmp_path, clock):
    stick, wires = FakeStick(), []

    def open_recording_port(url, baud):
        wires.append(RecordingPort(url, baud))
        return wires[-1]

    with run_boards(clock) as ports:
        driver = MC68HC11Driver(
            ROBOT, {"port": ports[0], "second_port": ports[1]}, open_port=open_recording_port
        )
        session = MotionSession(driver)
        sources = {"hid": HidSource(load=lambda: stick)}
        operation = OperatorControl(
            session, tmp_path / "config", tmp_path / "data", sources=sources
        )
        session.start()
        wait_until(lambda: session.snapshot().phase is SessionPhase.READY)
        operation.start()
        wait_until(lambda: "x" in operation.intent.deflections)
        rng, latencies = np.random.default_rng(1), []
        # The stick moves up and down gradually, because a jump would be rejected.
        level, step, speeds = 0.3, 0.08, wires[0].speeds
        stick.push(level)
        wait_until(lambda: bool(speeds))
        for _ in range(CHANGES):
            time.sleep(rng.uniform(0.03, 0.06))
            step = np.copysign(0.08, step if 0.2 < level + step < 0.9 else -step)
            level += step
            speed_count, previous_speed = len(speeds), speeds[-1][1]
            # A quarter of the coming change of speed, in steps per second.
            min_change = step * 0.25 * 1e4
            begin_s = time.monotonic()
            stick.push(level)

            def find_arrival_times(
                since=speed_count, previous_speed=previous_speed, min_change=min_change
            ):
                new_speeds = list(speeds[since:])
                return [
                    arrival_s
                    for arrival_s, speed in new_speeds
                    if (speed - previous_speed) / min_change > 1.0
                ]

            wait_until(lambda: len(find_arrival_times()) > 0)
            latencies.append(find_arrival_times()[0] - begin_s)
        stick.push(0.0)
        operation.close()
        session.close()
    latencies = 1e3 * np.array(latencies)
    print(
        f"\nstick to wire, {clock} MHz, {CHANGES} changes, ms: median {np.median(latencies):.1f} "
        f"(limit 10), 99 % {np.percentile(latencies, 99):.1f} (20), worst {latencies.max():.1f}"
    )
