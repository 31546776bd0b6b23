"""Sessions that a test steps, a driver that fails on request, and boards as processes."""

import subprocess
import sys
from contextlib import contextmanager

import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import FaultRaised
from rotemina.drivers.contract import DeviceState, VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.robot_files import load_robot

# Property that the summary of a test run counts.
RETRY_PROPERTY = "tried again"
MAX_TRIES = 4
STARVATION_SYMPTOMS = (
    "a set-point came too late",
    "the host was silent",
    "has not answered for",
    "the device does not answer",
    "samples are missing",
)


class UnrulySimulator(Simulator):
    """The simulator; a test can run code before a hook with ``before[hook] = callable``."""

    name = "unruly"

    def __init__(self, *args, **settings):
        super().__init__(*args, **settings)
        self.before = {}
        self.stops = 0

    def fail(self, hook, error):
        """Raise this error in every call of a hook."""

        def raise_error():
            raise error

        self.before[hook] = raise_error

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


class SessionHarness:
    """A session without a thread, with its clock, driver and events."""

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

    def step_until(self, *activities, limit_s=60.0):
        for _ in range(round(limit_s / 0.02)):
            state = self.step(0.02)
            if state.activity in activities:
                return state
        raise AssertionError(f"still {self.session.snapshot()}")

    def step_until_idle(self):
        return self.step_until(DeviceState.IDLE)

    def settle(self):
        """Step until the machine is at rest, and then 0.1 s more."""
        self.step(0.02, 2)
        while not self.session.at_rest:
            self.step(0.02)
        return self.step(0.05, 2)

    def holds_position(self, seconds=0.4):
        """Return whether no command changes from now on."""
        before = dict(self.session.snapshot().command)
        return dict(self.step(0.02, round(seconds / 0.02)).command) == before

    def list_events(self, kind):
        return [event for event in self.events if isinstance(event, kind)]


@pytest.fixture
def clock():
    return VirtualClock(5.0)


@pytest.fixture
def harness(clock):
    return SessionHarness(UnrulySimulator(load_robot("rotemina"), clock=clock), clock).connect()


@pytest.fixture
def make_harness(clock):
    def make(robot="rotemina", connect=True, driver=UnrulySimulator, settings=None, **options):
        machine = load_robot(robot) if isinstance(robot, str) else robot
        harness = SessionHarness(driver(machine, settings, clock=clock), clock, **options)
        return harness.connect() if connect else harness

    return make


@pytest.fixture
def harness_type():
    return SessionHarness


@pytest.fixture
def board_process():
    """Serve both boards, each on its own pseudo-terminal; yield the ports and standard input."""

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
def retry_when_starved(request):
    """Return a function that repeats a real-time test if the machine was too busy.

    On a busy machine the program or the boards exceed their time-outs. The motion then ends, as it
    must, or samples are missing. The function under test receives a list, which it fills with the
    events of the session.
    """

    def retry_when_starved(work, tries=MAX_TRIES):
        events = []
        try:
            return work(events)
        except (AssertionError, InputError) as error:
            messages = [
                str(error),
                *(event.message for event in events if isinstance(event, FaultRaised)),
            ]
            if tries == 1 or not any(
                symptom in message_text
                for message_text in messages
                for symptom in STARVATION_SYMPTOMS
            ):
                raise
            request.node.user_properties.append((RETRY_PROPERTY, str(messages[-1])))
        return retry_when_starved(work, tries - 1)

    return retry_when_starved
