"""A program that is killed while the machine moves: the boards halt it by their own watchdog."""

import re
import subprocess
import sys
import threading
import time

import pytest

from rotemina.drivers.errors import ConnectionLostError, DriverTimeoutError
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.samples import DeviceState
from rotemina.sim.robot.file import load_robot

pytestmark = pytest.mark.slow  # in real time
ROBOT = load_robot("rotemina")
WATCHDOG_S = 0.5
LATE_S = 0.3  # of a busy computer, and of the boards' own looks at their watchdog
LONG_S = 60.0
TRIES = 4
EARLY_S = 0.02  # of the clocks' agreement
PROGRAM = """
import sys, time
import numpy as np
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

ports = dict(zip(("port", "second_port"), sys.argv[2:]))
session = MotionSession(MC68HC11(load_robot("rotemina"), ports))
session.start()

def wait(condition):
    while not condition():
        if session.snapshot().fault is not None:
            sys.exit(1)
        time.sleep(1e-3)

wait(lambda: session.snapshot().locked is None and session.at_rest)
begin = dict(session.snapshot().command)
time_s = np.arange(1001) / 100.0
axis, request = {
    "positional": ("x", lambda: session.go_to({"x": 0.05})),
    "playback": ("x", lambda: session.play(Record.from_signals(
        time_s, {("x", Tap.CMD): begin["x"] + 1e-3 * time_s}, {"x": "m"}))),
    "profile": ("zn", lambda: session.profiles.trigger()),
}[sys.argv[1]]
if sys.argv[1] == "profile":
    session.profiles.upload(Profile("zn", (ProfileSegment(3.0, 0.0, -30e-6, 20e-6),)))
    wait(lambda: session.at_rest)
request()
wait(lambda: abs(session.snapshot().command[axis] - begin[axis]) > 1e-6)
print(axis, flush=True)
time.sleep(600)
"""


class Boards:
    """The process of the boards, and what it notes."""

    def __init__(self):
        self.process = subprocess.Popen(
            [sys.executable, "-m", "rotemina.app.cli.main", "board", "--position-known"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.notes, self._came = [], threading.Condition()
        self._reader = threading.Thread(target=self._read)
        self._reader.start()
        self.ports = [self.until(f"listening on (.*): board {n}").group(1) for n in (1, 2)]
        self.began_s = float(self.until(r"0\.0000 s is (.*) s of").group(1))

    def _read(self):
        for line in self.process.stdout:
            with self._came:
                self.notes.append(line)
                self._came.notify_all()

    def until(self, pattern):
        def found():
            return next(filter(None, (re.match(pattern, one) for one in self.notes)), None)

        with self._came:
            assert self._came.wait_for(found, LONG_S), self.notes
        return found()

    def end(self):
        self.process.terminate()
        self.process.wait(LONG_S)
        self._reader.join()
        self.process.stdout.close()


def at_rest(ports):
    """Connect once more, and return the command where the machine stands, seen for a while."""
    driver = MC68HC11(ROBOT, dict(zip(("port", "second_port"), ports, strict=True)))
    driver.open()
    seen, end_s = [], time.monotonic() + 0.5
    while time.monotonic() < end_s or driver.status().state is DeviceState.MOVING:
        seen += driver.read().command.tolist()
        time.sleep(driver.service_period_s)
        assert time.monotonic() < end_s + LONG_S
    driver.close()
    assert seen[0] == seen[-1]
    return dict(zip(driver.axes, seen[-1], strict=True))


def killed(what, boards):
    """Kill a program in mid-motion; return the axis that moved, and when.

    None where the computer let program or boards wait for longer than they do for one another.
    """
    command = [sys.executable, "-c", PROGRAM, what, *boards.ports]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as program:
        axis = program.stdout.readline().strip()
        time.sleep(0.2)
        starved = program.poll() is not None
        killed_s = time.monotonic()
        program.kill()
    return None if starved else (axis, killed_s)


@pytest.mark.parametrize("what", ["positional", "playback", "profile"])
def test_the_boards_halt_what_a_killed_program_began(what):
    for _ in range(TRIES):
        boards = Boards()
        try:
            found = killed(what, boards)
            if found is None:
                continue
            axis, killed_s = found
            board = 1 if axis == "x" else 2
            pattern = rf"([0-9.]+) s: board {board}: fault (WATCHDOG|LATE_SETPOINT)"
            fault = boards.until(pattern)
            after_s = boards.began_s + float(fault.group(1)) - killed_s
            if after_s < -EARLY_S:
                continue  # the boards had starved before
            print(f"{what}: {fault.group(2)} {1e3 * after_s:.0f} ms after the program's end")
            assert after_s < WATCHDOG_S + LATE_S
            try:
                end = at_rest(boards.ports)
            except (ConnectionLostError, DriverTimeoutError):
                continue
            # On the way from the middle of the range, and not at its end.
            assert 0.0275 < end["x"] < 0.04 if axis == "x" else 22.6e-6 < end["zn"] < 32.5e-6, end
            return
        finally:
            boards.end()
    pytest.fail(f"the computer starved the boards {TRIES} times")
