"""Sessions that tests step by hand, a driver that misbehaves on request, and boards as they run."""

import subprocess
import sys
from contextlib import contextmanager

import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Faulted
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.robot.file import load_robot

TRIED_AGAIN = "tried again"  # as the summary of a run counts it
TRIES = 4
STARVED = (
    "a set-point came too late",
    "the host was silent",
    "has not answered for",
    "the device does not answer",
    "samples are missing",
)


class Unruly(Simulator):
    """The simulator, with hooks that a test may replace by ``before[hook] = callable``."""

    name = "unruly"

    def __init__(self, *args, **settings):
        super().__init__(*args, **settings)
        self.before = {}
        self.stops = 0

    def _run_before(self, hook):
        self.before.get(hook, lambda: None)()

    def _open(self):
        self._run_before("open")
        super()._open()

    def _move_to(self, targets, speeds, permit):
        self._run_before("move_to")
        super()._move_to(targets, speeds, permit)

    def _read(self):
        self._run_before("read")
        return super()._read()

    def _stop(self):
        self.stops += 1
        self._run_before("stop")
        super()._stop()


class Stepped:
    """A session without a thread, its clock, driver and events."""

    def __init__(self, driver, clock, **options):
        self.clock = clock
        self.driver = driver
        self.session = MotionSession(driver, **options)
        self.events = []
        self.session.subscribe(self.events.append)

    def connect(self):
        self.session.connect()
        self.session.run_once()
        return self

    def step(self, seconds=0.02, times=1):
        for _ in range(times):
            self.clock.advance(seconds)
            self.session.run_once()
        return self.session.snapshot()

    def until(self, *activities, limit_s=60.0):
        for _ in range(round(limit_s / 0.02)):
            state = self.step(0.02)
            if state.activity in activities:
                return state
        raise AssertionError(f"still {self.session.snapshot()}")

    def until_idle(self):
        return self.until(DeviceState.IDLE)

    def told(self, kind):
        return [event for event in self.events if isinstance(event, kind)]


@pytest.fixture
def clock():
    return VirtualClock(5.0)


@pytest.fixture
def stepped(clock):
    return Stepped(Unruly(load_robot("rotemina"), clock=clock), clock).connect()


@pytest.fixture
def make_stepped(clock):
    def make(robot="rotemina", connect=True, driver=Unruly, settings=None, **options):
        machine = load_robot(robot) if isinstance(robot, str) else robot
        made = Stepped(driver(machine, settings, clock=clock), clock, **options)
        return made.connect() if connect else made

    return make


@pytest.fixture
def stepped_type():
    return Stepped


@pytest.fixture
def board_process():
    """Serve both boards, each on a pseudo-terminal of its own; give names and standard input."""

    @contextmanager
    def board_process(robot, *options):
        command = [sys.executable, "-m", "rotemina.app.cli.main", "board", "--robot", str(robot)]
        with subprocess.Popen(
            [*command, "--position-known", *options],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        ) as process:
            try:
                lines = [process.stdout.readline() for _ in range(2)]
                assert all(line.startswith("listening on ") for line in lines), lines
                yield [line.split()[2].rstrip(":") for line in lines], process.stdin
            finally:
                process.terminate()
                process.communicate(timeout=10.0)

    return board_process


@pytest.fixture
def patiently(request):
    """Do what needs boards in real time; once more, where this machine was too busy for that.

    A machine that lets the program or the boards wait for longer than they do for one another
    ends a motion, as it must, or leaves holes in what is recorded. What is done is given a list to
    fill with the session's events.
    """

    def patiently(work, tries=TRIES):
        events = []
        try:
            return work(events)
        except (AssertionError, InputError) as error:
            said = [str(error), *(event.message for event in events if isinstance(event, Faulted))]
            if tries == 1 or not any(sign in one for one in said for sign in STARVED):
                raise
            request.node.user_properties.append((TRIED_AGAIN, said[-1]))
        return patiently(work, tries - 1)

    return patiently
