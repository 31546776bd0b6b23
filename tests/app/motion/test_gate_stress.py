"""Stops from real threads between the check and the execution of a request: the machine holds.

There are 40 stops of each kind, and a tenth of it on boards; `make soak` sets ROTEMINA_STRESS.
"""

import os
import threading
import time
from contextlib import suppress

import numpy as np
import pytest

from rotemina.app.motion.penetration import PenetrationParameters
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import ConnectionState, SessionPhase
from rotemina.app.operation import OperatorControl
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

pytestmark = pytest.mark.slow
ROBOT = load_robot("rotemina")
TIMES = int(os.environ.get("ROTEMINA_STRESS", "40"))
BOARD_SHARE = 0.1  # of the number on the simulator, because their line is in real time
# Of the stop after the request: about twice the time that the request takes to the device.
MAX_DELAY_S = {
    "go_to": 2e-3,
    "jog": 2e-3,
    "velocity": 2e-3,
    "play": 10e-3,
    "recentre": 100e-3,
    "penetrate": 20e-3,
}
BRAKING_S = 0.1  # for any axis from any speed
HOLD_S = 0.03  # observation time after each stop, on a machine at rest
MAX_WAIT_S = 30.0
TIME_S = np.arange(101) / 100.0
BOW = 1e-3 * np.sin(np.pi * TIME_S) ** 2


class StressedSession:
    """A session with its thread, and requests of every kind."""

    def __init__(self, session, folder):
        self.session = session
        self.operation = OperatorControl(session, folder, folder, notify=lambda _: None)
        self.begun_motions = 0
        session.start()
        self.wait_until(lambda: session.snapshot().phase is SessionPhase.READY)

    def wait_until(self, condition, limit_s=MAX_WAIT_S):
        end_s = time.monotonic() + limit_s
        pause = threading.Event()
        while not condition():
            assert time.monotonic() < end_s, self.session.snapshot()
            pause.wait(1e-3)

    def is_at_rest(self):
        state = self.session.snapshot()
        return self.session.at_rest and not state.stopping and state.silent_s == 0.0

    def is_lost(self):
        return self.session.snapshot().connection is not ConnectionState.CONNECTED

    def has_rested_since(self, host_time_s):
        return self.session.snapshot().sample_host_time_s > host_time_s and self.is_at_rest()

    def recover(self):
        """Recover as an operator would; the boards may have starved on a busy computer."""
        session = self.session

        def can_move():
            state = session.snapshot()
            with suppress(InputError):
                if state.connection is ConnectionState.FAILED:
                    session.reconnect()
                elif state.fault is not None:
                    session.service.clear_fault()
                elif state.lock_reason and "confirm" in state.lock_reason:
                    session.confirm_position()
            return state.lock_reason is None and self.is_at_rest()

        self.wait_until(can_move)

    # Requests, each reversed before an end of the range

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
        """Press the button, and step as the loop does."""
        penetration = self.operation.penetration
        penetration.press_button(time.monotonic())
        for _ in range(3):
            penetration.step(time.monotonic())

    def prepare(self, kind):
        penetration = self.operation.penetration
        if kind == "penetrate":
            penetration.step(time.monotonic())  # it processes the previous stop, and holds
            penetration.disarm()
            self.bring_near(63e-6)  # room for a penetration downwards
            self.wait_until(self.is_at_rest)
            penetration.arm(PenetrationParameters(), time.monotonic())
        elif kind == "recentre":
            self.bring_near(20e-6)

    def bring_near(self, zn, near=5e-7):
        """Bring the nano axis near a position, m."""
        if abs(self.session.snapshot().command["zn"] - zn) > near:
            self.session.go_to({"zn": zn})
            self.wait_until(lambda: abs(self.session.snapshot().command["zn"] - zn) <= near)
            self.recover()

    # The stop

    def stop_during_request(self, kind, delay_s):
        """Send a request on one thread and stop from another; then the machine must hold."""
        self.recover()
        self.prepare(kind)
        start = threading.Barrier(2)

        def send_request():
            start.wait()
            with suppress(InputError):
                getattr(self, kind)()

        request_thread = threading.Thread(target=send_request)
        request_thread.start()
        start.wait()
        stop_s = time.monotonic() + delay_s
        while time.monotonic() < stop_s:
            pass
        before = self.session.snapshot()
        self.session.emergency_stop()
        self.assert_holds(request_thread)
        has_moved = dict(self.session.snapshot().command) != dict(before.command)
        self.begun_motions += has_moved or before.activity is not DeviceState.IDLE
        self.session.release()

    def assert_holds(self, request_thread):
        request_thread.join()
        # A motion from before the stop still brakes, and an older state would show it at rest.
        braked_s = self.session.stop_requested_s + BRAKING_S
        self.wait_until(lambda: self.is_lost() or self.has_rested_since(braked_s))
        if self.is_lost():  # the line was starved; the boards hold by themselves
            return
        before = dict(self.session.snapshot().command)
        end_s = time.monotonic() + HOLD_S
        self.wait_until(lambda: time.monotonic() > end_s)
        planning = self.operation._planning_thread
        if planning is not None:
            planning.join()
        assert self.is_lost() or dict(self.session.snapshot().command) == before


def run_stress(driver, folder, kinds, times):
    """Stop ``times`` times during requests of each kind."""
    rng = np.random.default_rng(1)
    stress = StressedSession(MotionSession(driver), folder)
    try:
        for kind in kinds:
            stress.begun_motions = 0
            for _ in range(times):
                stress.stop_during_request(kind, rng.uniform(0.0, MAX_DELAY_S[kind]))
            print(f"{kind}: {times} stops, {stress.begun_motions} of them during a motion")
    finally:
        stress.operation.close()
        stress.session.close()


@pytest.mark.parametrize("kind", MAX_DELAY_S)
def test_the_simulator_holds_wherever_a_stop_meets_a_request(tmp_path, kind):
    run_stress(Simulator(ROBOT), tmp_path, (kind,), TIMES)


def test_the_boards_hold_wherever_a_stop_meets_a_request(tmp_path, board_process):
    with board_process("rotemina") as ((port, second), _):
        driver = MC68HC11Driver(ROBOT, {"port": port, "second_port": second})
        run_stress(driver, tmp_path, MAX_DELAY_S, max(round(BOARD_SHARE * TIMES), 1))
