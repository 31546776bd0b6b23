"""A random run with the true plant watched: inside the range, and at rest after a stop.

A hundredth of it by default; `make soak` does ROTEMINA_OPERATIONS on the simulator, and a tenth as
many on boards. Time is virtual.
"""

import os

import numpy as np
import pytest
from tests.app.motion.test_bounds_and_readings import IN_ANY_ORDER

from rotemina.app.motion.session import MotionSession
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

pytestmark = pytest.mark.slow
ROBOT = load_robot("rotemina")
OPERATIONS = int(os.environ.get("ROTEMINA_OPERATIONS", "1000"))
# Of the range, by which a machine at rest may still ring or creep after a stop.
STILL = {"x": 1e-5, "y": 1e-5, "z": 1e-5, "thx": 2e-3, "thy": 2e-3, "zn": 2e-2}
TIME_S = np.arange(60) / 200.0
BOW = 0.02 * np.sin(np.pi * TIME_S / TIME_S[-1]) ** 2


class RandomRun:
    """A session stepped by hand, and what must hold of the true positions in every round."""

    def __init__(self, driver, clock, true_positions, *, round_s, seed):
        self.round_s = round_s
        self.rng = np.random.default_rng(seed)
        self.clock = clock
        self.true_positions = true_positions
        self.session = MotionSession(driver)
        self.low, self.high = np.array([axis.range for axis in ROBOT.axes.values()]).T
        self.span = self.high - self.low
        self.beyond = np.zeros(len(self.span))  # the most so far, of the range
        self.accepted = self.stops = 0
        self.session.connect()
        self.run(0.3)

    def run(self, seconds):
        for _ in range(max(round(seconds / self.round_s), 1)):
            self.clock.advance(self.round_s)
            self.session.run_once()
            at = self.true_positions()
            beyond = np.maximum(self.low - at, at - self.high) / self.span
            self.beyond = np.maximum(self.beyond, beyond)
            assert (beyond <= list(IN_ANY_ORDER.values())).all(), beyond

    def ask(self, request):
        try:
            request()
            self.accepted += 1
        except InputError:
            pass

    def stop(self):
        """Stop in the middle of it all; once it rests, nothing moves, though requests come."""
        session, latch = self.session, self.rng.uniform() < 0.5
        if latch:
            session.emergency_stop()
        else:
            session.stop()
        self.stops += 1
        for _ in range(50):
            self.run(0.05)
            if session.snapshot().activity is DeviceState.IDLE:
                break
        command = dict(session.snapshot().command)
        self.run(0.5)  # until a piezo's ringing has died away
        at = self.true_positions()
        if latch:
            before = self.accepted
            self.act(self.rng.integers(6))
            assert self.accepted == before
        self.run(0.1)
        assert dict(session.snapshot().command) == command
        moved = np.abs(self.true_positions() - at) / self.span
        assert (moved <= list(STILL.values())).all(), moved
        session.release()

    def act(self, kind):
        rng, session = self.rng, self.session
        axis = list(ROBOT.axes)[rng.integers(len(ROBOT.axes))]
        low, high = ROBOT.axes[axis].range
        target = float(rng.choice([low, high, rng.uniform(low, high)]))
        if kind in (0, 1):
            self.ask(lambda: session.go_to({axis: target}))
        elif kind == 2:
            self.ask(lambda: session.jog(axis, float(rng.normal(0.0, 0.1)) * (high - low)))
        elif kind == 3:
            speed = float(rng.uniform(-1.0, 1.0)) * (ROBOT.axes[axis].max_speed or 0.0)
            self.ask(lambda: session.move_velocity({axis: speed}, 0.15))
        elif kind == 4:
            start = session.snapshot().command[axis]
            way = start + BOW * (high - low) * (1.0 if start < 0.5 * (low + high) else -1.0)
            path = Record.from_signals(TIME_S, {(axis, Tap.CMD): way}, {axis: ROBOT.unit(axis)})
            self.ask(lambda: session.play(path))
        else:
            self.ask(session.undo)

    def operate(self, count):
        for _ in range(count):
            kind = self.rng.integers(8)
            if kind == 7:
                self.stop()
            elif kind == 6:
                self.run(float(self.rng.uniform(0.1, 0.5)))
            else:
                self.act(kind)
            self.run(float(self.rng.uniform(0.0, 0.1)))
        most = dict(zip(ROBOT.axes, (100.0 * self.beyond).round(4).tolist(), strict=True))
        print(
            f"{count} operations: {self.accepted} accepted, {self.stops} stops; most beyond "
            f"the range, %: {most}"
        )
        assert self.accepted > count / 20
        assert self.stops > count / 20
        self.session.close()


def test_the_simulated_machine_stays_in_its_range_and_rests_after_a_stop():
    clock = VirtualClock(5.0)
    driver = Simulator(ROBOT, clock=clock)
    run = RandomRun(driver, clock, lambda: np.array(driver.true_positions), round_s=0.02, seed=7)
    run.operate(OPERATIONS)


def test_the_machine_of_the_boards_does_too(joined_bench):
    bench = joined_bench(ROBOT, seed=3)

    def true_positions():
        bench.boards.machine.simulate()
        return bench.boards.machine.position.copy()

    RandomRun(bench.driver, bench.clock, true_positions, round_s=2e-3, seed=8).operate(
        OPERATIONS // 10
    )
