"""A program that is killed while the machine moves: the watchdog of the boards halts it."""

import re
import subprocess
import sys
import threading
import time

import pytest

from rotemina.drivers.contract import ConnectionLostError, DeviceState, DriverTimeoutError
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.sim.robot_files import load_robot

pytestmark = pytest.mark.slow  # in real time
ROBOT = load_robot("rotemina")
WATCHDOG_S = 0.5
TOLERANCE_S = 0.3  # for a busy computer and the polling of the watchdog
MAX_WAIT_S = 60.0
TRIES = 4
CLOCK_TOLERANCE_S = 0.02
PROGRAM = """
import sys, time
import numpy as np
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.abilities import MotionProfile, ProfileSegment
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ports = dict(zip(("port", "second_port"), sys.argv[2:]))
session = MotionSession(MC68HC11Driver(load_robot("rotemina"), ports))
session.start()

def wait(condition):
    while not condition():
        if session.snapshot().fault is not None:
            sys.exit(1)
        time.sleep(1e-3)

wait(lambda: session.snapshot().lock_reason is None and session.at_rest)
begin = dict(session.snapshot().command)
time_s = np.arange(1001) / 100.0
axis, request = {
    "positional": ("x", lambda: session.go_to({"x": 0.05})),
    "playback": ("x", lambda: session.play(Record.from_signals(
        time_s, {("x", Tap.CMD): begin["x"] + 1e-3 * time_s}, {"x": "m"}))),
    "profile": ("zn", lambda: session.profiles.trigger()),
}[sys.argv[1]]
if sys.argv[1] == "profile":
    session.profiles.upload(MotionProfile("zn", (ProfileSegment(3.0, 0.0, -30e-6, 20e-6),)))
    wait(lambda: session.at_rest)
request()
wait(lambda: abs(session.snapshot().command[axis] - begin[axis]) > 1e-6)
print(axis, flush=True)
time.sleep(600)
"""


class BoardProcess:
    """The process of the boards, and its output."""

    def __init__(self):
        self.process = subprocess.Popen(
            [sys.executable, "-m", "rotemina.app.cli.main", "board", "--position-known"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.notes, self._changed = [], threading.Condition()
        self._reader = threading.Thread(target=self._read)
        self._reader.start()
        self.ports = [self.wait_for_note(f"listening on (.*): board {n}").group(1) for n in (1, 2)]
        self.began_s = float(self.wait_for_note(r"0\.0000 s is (.*) s of").group(1))

    def _read(self):
        for line in self.process.stdout:
            with self._changed:
                self.notes.append(line)
                self._changed.notify_all()

    def wait_for_note(self, pattern):
        def find_note():
            return next(filter(None, (re.match(pattern, note) for note in self.notes)), None)

        with self._changed:
            assert self._changed.wait_for(find_note, MAX_WAIT_S), self.notes
        return find_note()

    def end(self):
        self.process.terminate()
        self.process.wait(MAX_WAIT_S)
        self._reader.join()
        self.process.stdout.close()


def read_position_at_rest(ports):
    """Connect again, check that the machine stays at rest, and return its command."""
    driver = MC68HC11Driver(ROBOT, dict(zip(("port", "second_port"), ports, strict=True)))
    driver.open()
    commands, end_s = [], time.monotonic() + 0.5
    while time.monotonic() < end_s or driver.status().state is DeviceState.MOVING:
        commands += driver.read().command.tolist()
        time.sleep(driver.service_period_s)
        assert time.monotonic() < end_s + MAX_WAIT_S
    driver.close()
    assert commands[0] == commands[-1]
    return dict(zip(driver.axes, commands[-1], strict=True))


def kill_during_motion(motion, boards):
    """Kill a program during a motion; return the axis and the time, s.

    Return None if the program had already ended because the computer was too busy.
    """
    command = [sys.executable, "-c", PROGRAM, motion, *boards.ports]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as program:
        axis = program.stdout.readline().strip()
        time.sleep(0.2)
        has_ended_early = program.poll() is not None
        killed_s = time.monotonic()
        program.kill()
    return None if has_ended_early else (axis, killed_s)


@pytest.mark.parametrize("motion", ["positional", "playback", "profile"])
def test_the_boards_halt_the_motion_of_a_killed_program(motion):
    for _ in range(TRIES):
        boards = BoardProcess()
        try:
            killed_motion = kill_during_motion(motion, boards)
            if killed_motion is None:
                continue
            axis, killed_s = killed_motion
            board = 1 if axis == "x" else 2
            pattern = rf"([0-9.]+) s: board {board}: fault (WATCHDOG|LATE_SETPOINT)"
            fault = boards.wait_for_note(pattern)
            after_s = boards.began_s + float(fault.group(1)) - killed_s
            if after_s < -CLOCK_TOLERANCE_S:
                continue  # the boards had starved before the kill
            print(f"{motion}: {fault.group(2)} {1e3 * after_s:.0f} ms after the program's end")
            assert after_s < WATCHDOG_S + TOLERANCE_S
            try:
                end = read_position_at_rest(boards.ports)
            except (ConnectionLostError, DriverTimeoutError):
                continue
            # The axis is on its way from the middle of the range, and not at its end.
            assert 0.0275 < end["x"] < 0.04 if axis == "x" else 22.6e-6 < end["zn"] < 32.5e-6, end
            return
        finally:
            boards.end()
    pytest.fail(f"the computer starved the boards {TRIES} times")
