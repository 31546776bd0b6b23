"""A session on boards whose lines, supply and sensors misbehave at random, at accelerated pace.

Four minutes of life by default, in a minute or so; `make soak` lives for an hour. What must hold
whatever happens: the machine is never commanded beyond its range, nothing moves after a stop, and
nothing piles up.
"""

import gc
import os

import numpy as np
import pytest

from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection, Phase
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.virtual_board.fault_injection import RandomFaults, inject
from rotemina.sim.errors import InputError
from rotemina.sim.records.record import Record, Tap

pytestmark = pytest.mark.slow
LIFE_S = float(os.environ.get("ROTEMINA_SOAK_S", "240"))
ROUND_S = 0.002
MISHAPS_HZ = 0.5
OVERTRAVEL = 0.015  # of a range, that homing may go below it to find the switch
BRAKING_S = 0.1  # at least, of an axis at half its greatest speed
GROWTH = 5000  # objects
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


def objects():
    """How many there are that a collection leaves."""
    gc.collect()
    return len(gc.get_objects())


class Soak:
    """A session stepped by hand, its boards, and what must hold in every round."""

    def __init__(self, bench, seed):
        self.bench = bench
        self.rng = np.random.default_rng(seed)
        self.session = MotionSession(bench.driver)
        self.session.connect()
        self.mishaps = RandomFaults(bench.boards, MISHAPS_HZ, seed)
        self.ranges = np.array([axis.range for axis in self.session.robot.axes.values()])
        self.steps = np.array([1e-7, 1e-7, 1e-7, 2e-8, 2e-8, 1e-9])
        self.accepted = self.refused = self.connections = self.stops = 0
        self.before = self.machine.command.copy()
        self.since_homing_s = np.full(2, np.inf)
        self.still = None  # what boards commanded when they came to rest after a stop

    @property
    def machine(self):
        return self.bench.boards.machine

    @property
    def lived_s(self):
        return self.bench.clock() - self.bench.begin_s

    def run(self, seconds):
        for _ in range(round(seconds / ROUND_S)):
            self.bench.clock.advance(ROUND_S)
            self.mishaps.live(self.bench.clock() - self.bench.begin_s)
            self.session.run_once()
            self.check()

    def check(self):
        command, span = self.machine.command, np.ptp(self.ranges, axis=1)
        homing = np.array([bool(board.homing) for board in self.bench.boards.boards])
        switch = self.ranges[:, 0] - OVERTRAVEL * span
        # A search for the switch that was cut off brakes, and leaves an axis below its range: from
        # there it goes no lower.
        self.since_homing_s = np.where(homing, 0.0, self.since_homing_s + ROUND_S)
        searching = np.repeat(self.since_homing_s < BRAKING_S, 3)
        lowest = np.where(searching, switch, np.minimum(self.ranges[:, 0], self.before))
        assert (command >= lowest - self.steps).all(), (command, lowest)
        assert (command <= self.ranges[:, 1] + self.steps).all(), command
        self.before = command.copy()
        if self.still is not None:
            np.testing.assert_array_equal(command, self.still)

    def ask(self, request):
        self.still = None
        try:
            request()
            self.accepted += 1
        except InputError:
            self.refused += 1

    def stop(self):
        """Stop; from when the boards are at rest on, nothing may move until somebody asks."""
        self.session.stop()
        self.stops += 1
        self.still = None
        for _ in range(20):
            self.run(0.1)
            if not self.bench.boards.moving:
                break
        assert not self.bench.boards.moving
        self.still = self.machine.command.copy()
        self.run(0.3)

    def recover(self):
        """Do what an operator would, until motion is possible or something stands in the way."""
        self.still = None
        for _ in range(4):
            state = self.session.snapshot()
            if state.connection is not Connection.CONNECTED:
                self.ask(self.session.reconnect)
                self.connections += 1
            elif state.fault is not None:
                self.ask(self.session.service.clear_fault)
            elif state.unhomed:
                self.ask(self.session.home)
                self.until_idle(20.0)
            elif state.locked and "confirm" in state.locked:
                self.ask(self.session.confirm_position)
            else:
                return
            self.run(0.3)

    def until_idle(self, limit_s):
        for _ in range(round(limit_s / 0.1)):
            self.run(0.1)
            if self.session.snapshot().activity is not DeviceState.HOMING:
                return

    def act(self):
        rng, session = self.rng, self.session
        axes = list(session.robot.axes)
        axis = axes[rng.integers(len(axes))]
        low, high = session.robot.axes[axis].range
        if rng.uniform() < 0.8:  # most of the time where homing is short
            high = low + 0.15 * (high - low)
        kind = rng.integers(8)
        if kind == 0:
            self.ask(lambda: session.go_to({axis: float(rng.uniform(low, high))}))
        elif kind == 1:
            self.ask(lambda: session.jog(axis, float(rng.normal(0, 0.1) * (high - low))))
        elif kind in (2, 3):
            speed = float(rng.uniform(-1, 1)) * session.robot.axes[axis].max_speed
            for _ in range(rng.integers(1, 6)):
                self.ask(lambda: session.move_velocity({axis: speed}, 0.15))
                self.run(0.05)
        elif kind == 4:
            self.ask(lambda: session.play(self.swing(axis)))
            self.run(0.5)
        elif kind == 5:
            self.stop()
        elif kind == 6:
            self.ask(session.undo)
        else:
            inject(self.bench.boards, FAULTS[rng.integers(len(FAULTS))])
        self.run(float(rng.uniform(0.02, 0.4)))

    def swing(self, axis):
        low, high = self.session.robot.axes[axis].range
        time_s = np.arange(200) * 5e-3
        wave = 0.05 + 0.002 * np.sin(2 * np.pi * time_s)
        return Record.from_signals(
            time_s,
            {(axis, Tap.CMD): low + (high - low) * wave},
            {axis: self.session.robot.unit(axis)},
        )


def test_nothing_moves_beyond_its_range_or_after_a_stop(robot, joined_bench):
    soak = Soak(joined_bench(robot, seed=3, start_fraction=0.05), seed=5)
    soak.run(0.3)
    assert soak.session.snapshot().phase is Phase.READY
    before = 0
    while soak.lived_s < LIFE_S:
        soak.recover()
        soak.act()
        if not before and soak.lived_s > 0.3 * LIFE_S:
            before = objects()
    print(
        f"{soak.lived_s:.0f} s of life: {soak.accepted} requests, {soak.refused} refused, "
        f"{soak.stops} stops, {soak.connections} connections"
    )
    assert soak.accepted > 30
    assert soak.stops > 3
    assert objects() - before < GROWTH
    soak.session.close()
