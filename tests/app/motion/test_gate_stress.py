"""Real threads at the window between a request's check and its act: the machine holds after a stop.

200 of each kind, a tenth on boards; `make soak` asks ROTEMINA_STRESS times.
"""

import os
import threading
import time
from contextlib import contextmanager, suppress

import numpy as np
import pytest

from rotemina.app.motion.operation import Operation
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection, Phase
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

pytestmark = pytest.mark.slow
ROBOT = load_robot("rotemina")
TIMES = int(os.environ.get("ROTEMINA_STRESS", "200"))
ON_BOARDS = 0.1  # as often: their line is in real time
# Of the stop, after the request: about twice what it takes from there to the device.
LATEST_S = {
    "go_to": 2e-3,
    "jog": 2e-3,
    "velocity": 2e-3,
    "play": 10e-3,
    "recentre": 100e-3,
    "penetrate": 20e-3,
}
BRAKING_S = 0.1  # of any axis from any speed
HOLDS_S = 0.03  # watched after each stop, on a machine at rest
REST_S = 30.0
TIME_S = np.arange(101) / 100.0
BOW = 1e-3 * np.sin(np.pi * TIME_S) ** 2


class Stress:
    """A session with its thread, and requests of every kind."""

    def __init__(self, session, folder):
        self.session = session
        self.operation = Operation(session, folder, folder, told=lambda _: None)
        self.begun = 0
        session.start()
        self.wait(lambda: session.snapshot().phase is Phase.READY)

    def wait(self, condition, limit_s=REST_S):
        end_s = time.monotonic() + limit_s
        pause = threading.Event()
        while not condition():
            assert time.monotonic() < end_s, self.session.snapshot()
            pause.wait(1e-3)

    def rests(self):
        state = self.session.snapshot()
        return self.session.at_rest and not state.stopping and state.silent_s == 0.0

    def lost(self):
        return self.session.snapshot().connection is not Connection.CONNECTED

    def seen_since(self, host_time_s):
        return self.session.snapshot().sample_host_time_s > host_time_s and self.rests()

    def ready(self):
        """Recover as an operator would; the boards may have starved on a busy computer."""
        session = self.session

        def able():
            state = session.snapshot()
            with suppress(InputError):
                if state.connection is Connection.FAILED:
                    session.reconnect()
                elif state.fault is not None:
                    session.service.clear_fault()
                elif state.locked and "confirm" in state.locked:
                    session.confirm_position()
            return state.locked is None and self.rests()

        self.wait(able)

    # --- requests, each turned back before an end of the range ------------------------------------

    def go_to(self):
        x = self.session.snapshot().command["x"]
        self.session.go_to({"x": x + (0.01 if x < 0.03 else -0.01)})

    def jog(self):
        x = self.session.snapshot().command["x"]
        self.session.jog("x", 0.01 if x < 0.03 else -0.01)

    def velocity(self):
        x = self.session.snapshot().command["x"]
        self.session.move_velocity({"x": 0.01 if x < 0.03 else -0.01}, 0.15)

    def play(self):
        x = self.session.snapshot().command["x"]
        self.session.play(Record.from_signals(TIME_S, {("x", Tap.CMD): x + BOW}, {"x": "m"}))

    def recentre(self):
        self.operation.recentre()

    def penetrate(self):
        """Press the button, and step on as its loop does."""
        penetration = self.operation.penetration
        penetration.press(time.monotonic())
        for _ in range(3):
            penetration.step(time.monotonic())

    def prepare(self, kind):
        penetration = self.operation.penetration
        if kind == "penetrate":
            penetration.step(time.monotonic())  # it hears of the stop before, and holds
            penetration.disarm()
            self.bring(63e-6)  # room for the way of a penetration, downwards
            self.wait(self.rests)
            penetration.arm(PenetrationParameters(), time.monotonic())
        elif kind == "recentre":
            self.bring(20e-6)

    def bring(self, zn, near=5e-7):
        """Bring the nano axis near a position, m."""
        if abs(self.session.snapshot().command["zn"] - zn) > near:
            self.session.go_to({"zn": zn})
            self.wait(lambda: abs(self.session.snapshot().command["zn"] - zn) <= near)
            self.ready()

    # --- the attack -------------------------------------------------------------------------------

    def attack(self, kind, delay_s):
        """Ask on one thread and stop from another; when it rests it holds until the release."""
        self.ready()
        self.prepare(kind)
        together = threading.Barrier(2)

        def ask():
            together.wait()
            with suppress(InputError):
                getattr(self, kind)()

        asking = threading.Thread(target=ask)
        asking.start()
        together.wait()
        at_s = time.monotonic() + delay_s
        while time.monotonic() < at_s:
            pass
        before = self.session.snapshot()
        self.session.emergency_stop()
        self.holds(asking)
        moved = dict(self.session.snapshot().command) != dict(before.command)
        self.begun += moved or before.activity is not DeviceState.IDLE
        self.session.release()

    def holds(self, asking):
        asking.join()
        # What had begun before the stop brakes: a state of before would say that it rests.
        braked_s = self.session.stop_asked_s + BRAKING_S
        self.wait(lambda: self.lost() or self.seen_since(braked_s))
        if self.lost():  # a starved line; the boards hold by themselves
            return
        before = dict(self.session.snapshot().command)
        end_s = time.monotonic() + HOLDS_S
        self.wait(lambda: time.monotonic() > end_s)
        planning = self.operation._planning
        if planning is not None:
            planning.join()
        assert self.lost() or dict(self.session.snapshot().command) == before


@pytest.fixture
def simulator():
    @contextmanager
    def simulator():
        yield Simulator(ROBOT)

    return simulator


@pytest.fixture
def boards(board_process):
    @contextmanager
    def boards():
        with board_process("rotemina") as ((port, second), _):
            yield MC68HC11(ROBOT, {"port": port, "second_port": second})

    return boards


@pytest.mark.parametrize("machine", ["simulator", "boards"])
@pytest.mark.parametrize("kind", ["go_to", "jog", "velocity", "play", "recentre", "penetrate"])
def test_the_machine_holds_wherever_a_stop_meets_a_request(request, tmp_path, machine, kind):
    rng = np.random.default_rng(1)
    times = TIMES if machine == "simulator" else max(round(ON_BOARDS * TIMES), 1)
    with request.getfixturevalue(machine)() as driver:
        stress = Stress(MotionSession(driver), tmp_path)
        try:
            for _ in range(times):
                stress.attack(kind, rng.uniform(0.0, LATEST_S[kind]))
        finally:
            stress.operation.close()
            stress.session.close()
    print(f"{kind} on {machine}: {times} stops, {stress.begun} of a motion that had begun")
