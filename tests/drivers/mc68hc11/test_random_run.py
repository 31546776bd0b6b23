"""In a random run, the true positions stay in their ranges and at rest after a stop.

`make soak` sets ROTEMINA_OPERATIONS to 100 000. The run on boards does a tenth of the operations.
Time is virtual.
"""

import os

import numpy as np
import pytest
from tests.app.motion.test_bounds_and_readings import IN_ANY_ORDER

from rotemina.app.motion.session import MotionSession
from rotemina.drivers.contract import DeviceState, VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

pytestmark = pytest.mark.slow
ROBOT = load_robot("rotemina")
OPERATIONS = int(os.environ.get("ROTEMINA_OPERATIONS", "600"))
# Fraction of its range by which an axis may still ring or creep after a stop.
MAX_CREEP = {"x": 1e-5, "y": 1e-5, "z": 1e-5, "thx": 2e-3, "thy": 2e-3, "zn": 2e-2}
TIME_S = np.arange(60) / 200.0
BUMP = 0.02 * np.sin(np.pi * TIME_S / TIME_S[-1]) ** 2


class RandomRun:
    """A session that is run step by step, with a check of the true positions in every round."""

    def __init__(self, driver, clock, true_positions, *, round_s, seed):
        self.round_s = round_s
        self.rng = np.random.default_rng(seed)
        self.clock = clock
        self.true_positions = true_positions
        self.session = MotionSession(driver)
        self.low, self.high = np.array([axis.range for axis in ROBOT.axes.values()]).T
        self.span = self.high - self.low
        # Largest excess over the range so far, as a fraction of the range.
        self.max_excess = np.zeros(len(self.span))
        self.accepted = self.stops = 0
        self.session.connect()
        self.run(0.3)

    def run(self, seconds):
        for _ in range(max(round(seconds / self.round_s), 1)):
            self.clock.advance(self.round_s)
            self.session.run_once()
            positions = self.true_positions()
            excess = np.maximum(self.low - positions, positions - self.high) / self.span
            self.max_excess = np.maximum(self.max_excess, excess)
            assert (excess <= list(IN_ANY_ORDER.values())).all(), excess

    def try_request(self, request):
        try:
            request()
            self.accepted += 1
        except InputError:
            pass

    def stop(self):
        """Stop at any time. Once the machine rests, nothing moves, even if requests follow."""
        session, is_latched = self.session, self.rng.uniform() < 0.5
        if is_latched:
            session.emergency_stop()
        else:
            session.stop()
        self.stops += 1
        for _ in range(50):
            self.run(0.05)
            if session.snapshot().activity is DeviceState.IDLE:
                break
        command = dict(session.snapshot().command)
        # The ringing of a piezo dies away during this time.
        self.run(0.5)
        positions = self.true_positions()
        if is_latched:
            accepted_before = self.accepted
            self.act(self.rng.integers(6))
            assert self.accepted == accepted_before
        self.run(0.1)
        assert dict(session.snapshot().command) == command
        displacement = np.abs(self.true_positions() - positions) / self.span
        assert (displacement <= list(MAX_CREEP.values())).all(), displacement
        session.release()

    def act(self, kind):
        rng, session = self.rng, self.session
        axis = list(ROBOT.axes)[rng.integers(len(ROBOT.axes))]
        low, high = ROBOT.axes[axis].range
        target = float(rng.choice([low, high, rng.uniform(low, high)]))
        if kind in (0, 1):
            self.try_request(lambda: session.go_to({axis: target}))
        elif kind == 2:
            self.try_request(lambda: session.jog(axis, float(rng.normal(0.0, 0.1)) * (high - low)))
        elif kind == 3:
            speed = float(rng.uniform(-1.0, 1.0)) * (ROBOT.axes[axis].max_speed or 0.0)
            self.try_request(lambda: session.move_velocity({axis: speed}, 0.15))
        elif kind == 4:
            start = session.snapshot().command[axis]
            command = start + BUMP * (high - low) * (1.0 if start < 0.5 * (low + high) else -1.0)
            path = Record.from_signals(TIME_S, {(axis, Tap.CMD): command}, {axis: ROBOT.unit(axis)})
            self.try_request(lambda: session.play(path))
        else:
            self.try_request(session.undo)

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
        max_excess_percent = dict(
            zip(ROBOT.axes, (100.0 * self.max_excess).round(4).tolist(), strict=True)
        )
        print(
            f"{count} operations: {self.accepted} accepted, {self.stops} stops; largest excess "
            f"over the range, %: {max_excess_percent}"
        )
        assert self.accepted > count / 20
        assert self.stops > count / 20
        self.session.close()


def test_the_simulated_machine_stays_in_its_range_and_rests_after_a_stop():
    clock = VirtualClock(5.0)
    driver = Simulator(ROBOT, clock=clock)
    run = RandomRun(driver, clock, lambda: np.array(driver.true_positions), round_s=0.02, seed=7)
    run.operate(OPERATIONS)


def test_the_machine_of_the_boards_stays_in_its_range_and_rests_after_a_stop(make_bench):
    bench = make_bench(ROBOT, seed=3)

    def true_positions():
        bench.boards.machine.simulate()
        return bench.boards.machine.position.copy()

    RandomRun(bench.driver, bench.clock, true_positions, round_s=2e-3, seed=8).operate(
        OPERATIONS // 10
    )
