"""The boards at true baud: how soon a stop is heard, and how much of what they measure arrives.

``make bench`` runs it on a machine that does nothing else. The virtual boards are a process of its
own; what they print is on the same clock. A stop is timed from the call to its last byte
at the last board, while a trajectory plays on both, their displays are written to all the time, and
telemetry comes at 200 Hz; the time that the process takes until it reads its ports is in it.
"""

import os
import re
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

import numpy as np
import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Phase
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.mc68hc11.framing import MAX_FRAME
from rotemina.drivers.mc68hc11.line_budget import Line
from rotemina.drivers.samples import DeviceState
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.trajectory.dry_run import dry_run

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

ROBOT = load_robot("rotemina")
STOPS = 200
WITH_WINDOW = 60
SECONDS, CAPTURED = 20.0, 8000
CLOCKS = ("4", "2")  # MHz, E of the chip
HEARD = re.compile(r"^([\d.]+) s: board (\d): stop heard$")
BEGAN = re.compile(r"^0.0000 s is ([\d.]+) s of")
QUICK = {"STOPS": 2, "WITH_WINDOW": 2, "SECONDS": 2.0, "CAPTURED": 200}


class Boards:
    """The process, and when its boards heard a stop, host time s."""

    def __init__(self, process: subprocess.Popen) -> None:
        self.heard: list[tuple[float, int]] = []
        self.ports: list[str] = []
        self._began_s = float("nan")
        self._ready = threading.Event()
        self._process = process
        self._listener = threading.Thread(target=self._listen)
        self._listener.start()
        assert self._ready.wait(30.0)

    def first_after(self, host_time_s: float) -> dict[int, float]:
        """Return how long after a host time each board heard a stop first, s."""
        after: dict[int, float] = {}
        for heard_s, board in self.heard:
            if heard_s >= host_time_s - 1e-4:
                after.setdefault(board, heard_s - host_time_s)
        return after

    def end(self) -> None:
        """End the process, and read what it said last."""
        self._process.terminate()
        self._listener.join()

    def _listen(self) -> None:
        for line in self._process.stdout:
            if line.startswith("listening on "):
                self.ports.append(line.split()[2].rstrip(":"))
            elif began := BEGAN.match(line):
                self._began_s = float(began[1])
                self._ready.set()
            elif heard := HEARD.match(line):
                self.heard.append((self._began_s + float(heard[1]), int(heard[2])))


@contextmanager
def boards(*options: str) -> Iterator[Boards]:
    command = [sys.executable, "-m", "rotemina.app.cli.main", "board", "--position-known", *options]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        found = Boards(process)
        try:
            yield found
        finally:
            found.end()


def swing(period_s: float) -> Record:
    time_s = np.arange(0.0, 60.0, period_s)
    wave = np.sin(2 * np.pi * 0.5 * time_s)
    commands = {("x", Tap.CMD): 0.0275 + 5e-4 * wave, ("zn", Tap.CMD): 32e-6 + 2e-5 * wave}
    return Record.from_signals(time_s, commands, {"x": "m", "zn": "m"})


def rest() -> None:
    time.sleep(1e-3)


def until(
    condition: Callable[[], bool], wait: Callable[[], object] = rest, limit_s: float = 20.0
) -> None:
    end_s = time.monotonic() + limit_s
    while not condition():
        assert time.monotonic() < end_s
        wait()


def stops(
    session: MotionSession, found: Boards, count: int, wait: Callable[[], object] = rest
) -> np.ndarray:
    """Stop a playback so often; return the time (count, boards) until each board heard it, s.

    Another thread stops than the one that waits, which may be painting.
    """
    until(lambda: session.snapshot().phase is Phase.READY, wait)
    plan = dry_run(
        ROBOT, swing(session.setpoint_period_s), setpoint_period_s=session.setpoint_period_s
    ).require()
    rng, waits = np.random.default_rng(0), []
    for number in range(count):
        session.play(plan)
        until(lambda: session.snapshot().progress > 0.0, wait)
        end_s = time.monotonic() + rng.uniform(0.05, 0.2)
        while time.monotonic() < end_s:
            with_text(session, number)
            wait()
        stopper = Stopper(session)
        stopper.start()
        until(lambda one=stopper: len(found.first_after(one.asked_s)) == 2, wait)
        waits.append(sorted(found.first_after(stopper.asked_s).values()))
        until(lambda: session.snapshot().activity is DeviceState.IDLE, wait)
        until(lambda: not session.snapshot().stopping, wait)
    return np.array(waits)


class Stopper(threading.Thread):
    """Stops a session, and notes when it was asked to."""

    def __init__(self, session: MotionSession) -> None:
        super().__init__()
        self.asked_s = float("inf")
        self._session = session

    def run(self) -> None:
        self.asked_s = time.monotonic()
        self._session.stop()


def with_text(session: MotionSession, number: int) -> None:
    """Keep the lines busy with what matters least."""
    with suppress(InputError):  # a full queue is what was wanted
        session.service.show(number % 2, f"stop {number}")


def told(name: str, waits: np.ndarray, limit_ms: float) -> None:
    last = 1e3 * waits.max(axis=1)
    print(
        f"{len(last)} stops, {name}: median {np.median(last):.2f} ms, "
        f"99 % {np.percentile(last, 99):.2f}, 99.9 % {np.percentile(last, 99.9):.2f} "
        f"(limit {limit_ms:.1f})"
    )


@pytest.mark.parametrize(("baud", "clock"), [(125_000, "4"), (125_000, "2"), (9_600, "4")])
def test_a_stop_is_heard_at_once(baud: int, clock: str) -> None:
    with boards("--baud", str(baud), "--clock", clock) as found:
        first, second = found.ports
        session = MotionSession(
            MC68HC11(ROBOT, {"port": first, "second_port": second, "baud": baud, "settle_s": 0.0})
        )
        session.start()
        waits = stops(session, found, STOPS if baud == 125_000 else 20)
        session.close()
    in_flight_ms = 1e3 * Line(baud).seconds(MAX_FRAME)
    told(
        f"{baud} baud, {clock} MHz, headless",
        waits,
        5.0 if baud == 125_000 else in_flight_ms + 2.0,
    )


def test_a_stop_is_heard_while_the_window_paints(tmp_path) -> None:
    from rotemina.app.settings import Settings
    from rotemina.app.shell.application import make_application
    from rotemina.app.shell.window_run import make_window

    application = make_application()
    with boards() as found:
        first, second = found.ports
        settings = {"port": first, "second_port": second, "settle_s": 0.0}
        session = MotionSession(MC68HC11(ROBOT, settings))
        window = make_window(session, Settings(tmp_path / "settings.json"), tmp_path)
        window.resize(1920, 1080)
        window.show()
        window.workbench.start()
        waits = stops(session, found, WITH_WINDOW, application.processEvents)
        window.workbench.close()
        window.hide()
    told("125000 baud, window painting", waits, 15.0)


@pytest.mark.parametrize("clock", CLOCKS)
def test_what_boards_measure_arrives(clock: str) -> None:
    with boards("--clock", clock) as found:
        first, second = found.ports
        driver = MC68HC11(ROBOT, {"port": first, "second_port": second})
        driver.open()
        try:
            live = read_for(driver, SECONDS)
            capture_hz = driver.capture_rates.one_hz
            driver.capture(["zn"], capture_hz, CAPTURED)
            parts = []
            end_s = time.monotonic() + 1.5 * CAPTURED / capture_hz
            while time.monotonic() < end_s:
                rest()
                driver.read()
                if (part := driver.captured()) is not None:
                    parts.append(part)
        finally:
            driver.close()
    periods = round((live[-1] - live[0]) / np.median(np.diff(live)))
    arrived = sum(len(part.device_time_s) for part in parts)
    print(
        f"{clock} MHz, lost, % (limit 0.1): six axes at {len(live) / SECONDS:.0f} Hz "
        f"{100 * (1 - (len(live) - 1) / periods):.3f}, one at {capture_hz:.0f} Hz "
        f"{100 * (1 - arrived / CAPTURED):.3f}"
    )


def read_for(driver: MC68HC11, seconds: float) -> np.ndarray:
    """Read a driver as a session does; return the times of its samples, s."""
    parts = []
    end_s = time.monotonic() + seconds
    while time.monotonic() < end_s:
        parts.append(driver.read().device_time_s)
        rest()
    return np.concatenate(parts)
