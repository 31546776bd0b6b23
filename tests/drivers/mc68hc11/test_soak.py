"""A session with boards whose lines, supply and sensors have random faults.

The test simulates two minutes by default, and an hour in `make soak`. The machine must never be
commanded beyond its range, nothing may move after a stop, and the number of objects must not grow.
"""

import gc
import os

import numpy as np
import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import ConnectionState, SessionPhase
from rotemina.drivers.contract import DeviceState
from rotemina.drivers.virtual_board import RandomFaults, inject_fault
from rotemina.sim.errors import InputError
from rotemina.sim.records import Record, Tap

pytestmark = pytest.mark.slow
DURATION_S = float(os.environ.get("ROTEMINA_SOAK_S", "120"))
ROUND_S = 0.002
FAULT_RATE_HZ = 0.5
# Fraction of a range by which homing may move below it to find the switch.
OVERTRAVEL = 0.015
# Minimum time in which an axis brakes from half its maximum speed.
BRAKING_S = 0.1
MAX_NEW_OBJECTS = 5000
FAULTS = (
    "reset 1",
    "reset 2",
    "brown-out 1",
    "brown-out 2",
    "freeze x",
    "thaw x",
    "silence 0.2 s",
    "silence 0.8 s",
    "space 0.1 s",
    "garbage 20",
)


def count_objects():
    """Return the number of objects after a garbage collection."""
    gc.collect()
    return len(gc.get_objects())


class Soak:
    """A session that is run step by step, its boards, and a check in every round."""

    def __init__(self, bench, seed):
        self.bench = bench
        self.rng = np.random.default_rng(seed)
        self.session = MotionSession(bench.driver)
        self.session.connect()
        self.random_faults = RandomFaults(bench.boards, FAULT_RATE_HZ, seed)
        self.ranges = np.array([axis.range for axis in self.session.robot.axes.values()])
        self.step_sizes = np.array([1e-7, 1e-7, 1e-7, 2e-8, 2e-8, 1e-9])
        self.accepted = self.refused = self.connections = self.stops = 0
        self.last_command = self.machine.command.copy()
        self.since_homing_s = np.full(2, np.inf)
        # The command of the boards when they came to rest after a stop.
        self.command_at_rest = None

    @property
    def machine(self):
        return self.bench.boards.machine

    @property
    def elapsed_s(self):
        return self.bench.clock() - self.bench.begin_s

    def run(self, seconds):
        for _ in range(round(seconds / ROUND_S)):
            self.bench.clock.advance(ROUND_S)
            self.random_faults.advance(self.bench.clock() - self.bench.begin_s)
            self.session.run_once()
            self.check()

    def check(self):
        command, span = self.machine.command, np.ptp(self.ranges, axis=1)
        homing = np.array([bool(board.homing) for board in self.bench.boards.boards])
        switch = self.ranges[:, 0] - OVERTRAVEL * span
        # An interrupted search for the switch can leave an axis below its range. The axis may brake
        # there, but then it must not move further down.
        self.since_homing_s = np.where(homing, 0.0, self.since_homing_s + ROUND_S)
        searching = np.repeat(self.since_homing_s < BRAKING_S, 3)
        lowest = np.where(searching, switch, np.minimum(self.ranges[:, 0], self.last_command))
        assert (command >= lowest - self.step_sizes).all(), (command, lowest)
        assert (command <= self.ranges[:, 1] + self.step_sizes).all(), command
        self.last_command = command.copy()
        if self.command_at_rest is not None:
            np.testing.assert_array_equal(command, self.command_at_rest)

    def try_request(self, request):
        self.command_at_rest = None
        try:
            request()
            self.accepted += 1
        except InputError:
            self.refused += 1

    def stop(self):
        """Stop. Once the boards are at rest, nothing may move until the next request."""
        self.session.stop()
        self.stops += 1
        self.command_at_rest = None
        for _ in range(20):
            self.run(0.1)
            if not self.bench.boards.moving:
                break
        assert not self.bench.boards.moving
        self.command_at_rest = self.machine.command.copy()
        self.run(0.3)

    def recover(self):
        """Act like an operator until motion is possible, at most four times."""
        self.command_at_rest = None
        for _ in range(4):
            state = self.session.snapshot()
            if state.connection is not ConnectionState.CONNECTED:
                self.try_request(self.session.reconnect)
                self.connections += 1
            elif state.fault is not None:
                self.try_request(self.session.service.clear_fault)
            elif state.unhomed:
                self.try_request(self.session.home)
                self.run_until_homed(20.0)
            elif state.lock_reason and "confirm" in state.lock_reason:
                self.try_request(self.session.confirm_position)
            else:
                return
            self.run(0.3)

    def run_until_homed(self, limit_s):
        for _ in range(round(limit_s / 0.1)):
            self.run(0.1)
            if self.session.snapshot().activity is not DeviceState.HOMING:
                return

    def act(self):
        rng, session = self.rng, self.session
        axes = list(session.robot.axes)
        axis = axes[rng.integers(len(axes))]
        low, high = session.robot.axes[axis].range
        # Most targets are close to the switch, so that homing is short.
        if rng.uniform() < 0.8:
            high = low + 0.15 * (high - low)
        kind = rng.integers(8)
        if kind == 0:
            self.try_request(lambda: session.go_to({axis: float(rng.uniform(low, high))}))
        elif kind == 1:
            self.try_request(lambda: session.jog(axis, float(rng.normal(0, 0.1) * (high - low))))
        elif kind in (2, 3):
            speed = float(rng.uniform(-1, 1)) * session.robot.axes[axis].max_speed
            for _ in range(rng.integers(1, 6)):
                self.try_request(lambda: session.move_velocity({axis: speed}, 0.15))
                self.run(0.05)
        elif kind == 4:
            self.try_request(lambda: session.play(self.make_wave(axis)))
            self.run(0.5)
        elif kind == 5:
            self.stop()
        elif kind == 6:
            self.try_request(session.undo)
        else:
            inject_fault(self.bench.boards, FAULTS[rng.integers(len(FAULTS))])
        self.run(float(rng.uniform(0.02, 0.4)))

    def make_wave(self, axis):
        low, high = self.session.robot.axes[axis].range
        time_s = np.arange(200) * 5e-3
        wave = 0.05 + 0.002 * np.sin(2 * np.pi * time_s)
        return Record.from_signals(
            time_s,
            {(axis, Tap.CMD): low + (high - low) * wave},
            {axis: self.session.robot.unit(axis)},
        )


def test_nothing_moves_beyond_its_range_or_after_a_stop(robot, make_bench):
    soak = Soak(make_bench(robot, seed=3, start_fraction=0.05), seed=5)
    soak.run(0.3)
    assert soak.session.snapshot().phase is SessionPhase.READY
    object_count_before = 0
    while soak.elapsed_s < DURATION_S:
        soak.recover()
        soak.act()
        if not object_count_before and soak.elapsed_s > 0.3 * DURATION_S:
            object_count_before = count_objects()
    print(
        f"{soak.elapsed_s:.0f} s simulated: {soak.accepted} requests, {soak.refused} refused, "
        f"{soak.stops} stops, {soak.connections} connections"
    )
    assert soak.accepted > 30
    assert soak.stops > 3
    assert count_objects() - object_count_before < MAX_NEW_OBJECTS
    soak.session.close()
