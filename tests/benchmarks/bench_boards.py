"""The boards at true baud: latency of a stop, and share of measured samples that arrive.

``make bench`` runs it on an idle machine. The virtual boards are a separate process, whose output
has times of the same clock. The latency of a stop is measured from the call to its last byte at the
last board. Meanwhile a trajectory plays on both boards, their displays are written continuously,
and telemetry runs at 200 Hz. The latency includes the time until the process reads its ports.
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
from rotemina.app.motion.state import SessionPhase
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.mc68hc11 import LineCapacity
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.mc68hc11.protocol import MAX_FRAME_BYTES
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot
from rotemina.sim.trajectory import dry_run

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

ROBOT = load_robot("rotemina")
STOPS = 200
STOPS_WITH_WINDOW = 60
SECONDS, CAPTURE_SAMPLES = 20.0, 8000
# E clock of the chip.
CLOCKS = ("4", "2")  # MHz
STOP_LINE = re.compile(r"^([\d.]+) s: board (\d): stop heard$")
START_LINE = re.compile(r"^0.0000 s is ([\d.]+) s of")
QUICK = {"STOPS": 2, "STOPS_WITH_WINDOW": 2, "SECONDS": 2.0, "CAPTURE_SAMPLES": 200}


class BoardProcess:
    """The process of the boards, and the host times, s, at which they received a stop."""

    def __init__(self, process: subprocess.Popen) -> None:
        self.stops: list[tuple[float, int]] = []
        self.ports: list[str] = []
        self._start_s = float("nan")
        self._ready = threading.Event()
        self._process = process
        self._listener = threading.Thread(target=self._listen)
        self._listener.start()
        assert self._ready.wait(30.0)

    def find_delays_after(self, host_time_s: float) -> dict[int, float]:
        """Return how long after a host time each board first received a stop, s."""
        delays_s: dict[int, float] = {}
        for stop_s, board in self.stops:
            if stop_s >= host_time_s - 1e-4:
                delays_s.setdefault(board, stop_s - host_time_s)
        return delays_s

    def end(self) -> None:
        """End the process, and read the rest of its output."""
        self._process.terminate()
        self._listener.join()

    def _listen(self) -> None:
        for line in self._process.stdout:
            if line.startswith("listening on "):
                self.ports.append(line.split()[2].rstrip(":"))
            elif match := START_LINE.match(line):
                self._start_s = float(match[1])
                self._ready.set()
            elif match := STOP_LINE.match(line):
                self.stops.append((self._start_s + float(match[1]), int(match[2])))


@contextmanager
def run_boards(*options: str) -> Iterator[BoardProcess]:
    command = [sys.executable, "-m", "rotemina.app.cli.main", "board", "--position-known", *options]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        board_process = BoardProcess(process)
        try:
            yield board_process
        finally:
            board_process.end()


def make_swing(period_s: float) -> Record:
    time_s = np.arange(0.0, 60.0, period_s)
    wave = np.sin(2 * np.pi * 0.5 * time_s)
    commands = {("x", Tap.CMD): 0.0275 + 5e-4 * wave, ("zn", Tap.CMD): 32e-6 + 2e-5 * wave}
    return Record.from_signals(time_s, commands, {"x": "m", "zn": "m"})


def sleep_briefly() -> None:
    time.sleep(1e-3)


def wait_until(
    condition: Callable[[], bool], wait: Callable[[], object] = sleep_briefly, limit_s: float = 20.0
) -> None:
    end_s = time.monotonic() + limit_s
    while not condition():
        assert time.monotonic() < end_s
        wait()


def measure_stops(
    session: MotionSession,
    board_process: BoardProcess,
    count: int,
    wait: Callable[[], object] = sleep_briefly,
) -> np.ndarray:
    """Stop a playback repeatedly; return the latency (count, boards) of each stop, s.

    A separate thread makes the stops, because the waiting thread may be painting.
    """
    wait_until(lambda: session.snapshot().phase is SessionPhase.READY, wait)
    plan = dry_run(
        ROBOT, make_swing(session.setpoint_period_s), setpoint_period_s=session.setpoint_period_s
    ).require()
    rng, latencies_s = np.random.default_rng(0), []
    for number in range(count):
        session.play(plan)
        wait_until(lambda: session.snapshot().progress > 0.0, wait)
        end_s = time.monotonic() + rng.uniform(0.05, 0.2)
        while time.monotonic() < end_s:
            send_text(session, number)
            wait()
        stopper = Stopper(session)
        stopper.start()
        wait_until(
            lambda stop=stopper: len(board_process.find_delays_after(stop.call_s)) == 2, wait
        )
        latencies_s.append(sorted(board_process.find_delays_after(stopper.call_s).values()))
        wait_until(lambda: session.snapshot().activity is DeviceState.IDLE, wait)
        wait_until(lambda: not session.snapshot().stopping, wait)
    return np.array(latencies_s)


class Stopper(threading.Thread):
    """Stops a session, and records the time of the call."""

    def __init__(self, session: MotionSession) -> None:
        super().__init__()
        self.call_s = float("inf")
        self._session = session

    def run(self) -> None:
        self.call_s = time.monotonic()
        self._session.stop()


def send_text(session: MotionSession, number: int) -> None:
    """Keep the lines busy with messages of the lowest priority."""
    # A full queue is intended.
    with suppress(InputError):
        session.service.show_text(number % 2, f"stop {number}")


def print_latencies(name: str, latencies_s: np.ndarray, limit_ms: float) -> None:
    last_board_ms = 1e3 * latencies_s.max(axis=1)
    print(
        f"{len(last_board_ms)} stops, {name}: median {np.median(last_board_ms):.2f} ms, "
        f"99 % {np.percentile(last_board_ms, 99):.2f}, 99.9 % "
        f"{np.percentile(last_board_ms, 99.9):.2f} "
        f"(limit {limit_ms:.1f})"
    )


@pytest.mark.parametrize(("baud", "clock"), [(125_000, "4"), (125_000, "2"), (9_600, "4")])
def test_a_stop_is_heard_at_once(baud: int, clock: str) -> None:
    with run_boards("--baud", str(baud), "--clock", clock) as board_process:
        first, second = board_process.ports
        session = MotionSession(
            MC68HC11Driver(
                ROBOT, {"port": first, "second_port": second, "baud": baud, "settle_s": 0.0}
            )
        )
        session.start()
        latencies_s = measure_stops(session, board_process, STOPS if baud == 125_000 else 20)
        session.close()
    in_flight_ms = 1e3 * LineCapacity(baud).compute_duration_s(MAX_FRAME_BYTES)
    print_latencies(
        f"{baud} baud, {clock} MHz, headless",
        latencies_s,
        5.0 if baud == 125_000 else in_flight_ms + 2.0,
    )


def test_a_stop_is_heard_while_the_window_paints(tmp_path) -> None:
    from rotemina.app.settings import UserSettings
    from rotemina.app.shell.startup.application import make_application
    from rotemina.app.shell.startup.window_run import make_window

    application = make_application()
    with run_boards() as board_process:
        first, second = board_process.ports
        settings = {"port": first, "second_port": second, "settle_s": 0.0}
        session = MotionSession(MC68HC11Driver(ROBOT, settings))
        window = make_window(session, UserSettings(tmp_path / "settings.json"), tmp_path)
        window.resize(1920, 1080)
        window.show()
        window.workbench.start()
        latencies_s = measure_stops(
            session, board_process, STOPS_WITH_WINDOW, application.processEvents
        )
        window.workbench.close()
        window.hide()
    print_latencies("125000 baud, window painting", latencies_s, 15.0)


@pytest.mark.parametrize("clock", CLOCKS)
def test_measured_samples_arrive(clock: str) -> None:
    with run_boards("--clock", clock) as board_process:
        first, second = board_process.ports
        driver = MC68HC11Driver(ROBOT, {"port": first, "second_port": second})
        driver.open()
        try:
            sample_times_s = read_sample_times(driver, SECONDS)
            capture_hz = driver.capture_rates.single_axis_hz
            driver.capture(["zn"], capture_hz, CAPTURE_SAMPLES)
            parts = []
            end_s = time.monotonic() + 1.5 * CAPTURE_SAMPLES / capture_hz
            while time.monotonic() < end_s:
                sleep_briefly()
                driver.read()
                if (part := driver.read_capture()) is not None:
                    parts.append(part)
        finally:
            driver.close()
    periods = round((sample_times_s[-1] - sample_times_s[0]) / np.median(np.diff(sample_times_s)))
    arrived_count = sum(len(part.device_time_s) for part in parts)
    print(
        f"{clock} MHz, lost, % (limit 0.1): six axes at {len(sample_times_s) / SECONDS:.0f} Hz "
        f"{100 * (1 - (len(sample_times_s) - 1) / periods):.3f}, one at {capture_hz:.0f} Hz "
        f"{100 * (1 - arrived_count / CAPTURE_SAMPLES):.3f}"
    )


def read_sample_times(driver: MC68HC11Driver, seconds: float) -> np.ndarray:
    """Read a driver as a session does; return the times of its samples, s."""
    parts = []
    end_s = time.monotonic() + seconds
    while time.monotonic() < end_s:
        parts.append(driver.read().device_time_s)
        sleep_briefly()
    return np.concatenate(parts)
