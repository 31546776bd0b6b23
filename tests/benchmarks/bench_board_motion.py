"""Motion on virtual boards at both clocks: re-centring and a penetration, the true tip looked at.

The program and the boards share a clock that this sets by hand, so that a busy machine changes
nothing. The true tip is what the model makes of the commands that acted, looked at between ticks.
"""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.penetration import Penetration
from rotemina.app.motion.penetration.run_log import Verdict
from rotemina.app.motion.penetration.status import UNDER_WAY
from rotemina.app.motion.penetration.status import Phase as Step
from rotemina.app.motion.penetration.thrust import plan_thrust
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Phase
from rotemina.app.motion.teleoperation.recentring import plan_recentring
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.virtual_board.boards import VirtualBoards
from rotemina.sim.kinematics.chain import JOINTS, Chain
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.plant.plant import Plant
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")
CLOCKS = (4, 2)  # MHz, E of the chip
LOOK_S = 5e-5
ROUND_S = 2e-3
REST_S = 0.05  # without motion parts the approach from the thrust
START, PLACES = 64e-6, 8  # of zn above the cells, and how many of these
AWAY = 31e-6  # of zn from mid-range
QUICK = {"PLACES": 1, "AWAY": 2e-6}


class Port:
    """A line in memory."""

    def __init__(self, line, clock, begin_s):
        self._line, self._clock, self._begin_s = line, clock, begin_s

    def read(self):
        return self._line.advance(self._clock() - self._begin_s)

    def write(self, data):
        self._line.receive(data, self._clock() - self._begin_s)

    def waiting(self):
        return 0

    def close(self):
        pass


class Bench:
    """A session on boards; ``acted`` is every command (ticks, axes) that acted, in parts."""

    def __init__(self, clock_mhz, robot=ROBOT):
        self.clock = VirtualClock(1.0)
        self.tick_s = 2e-3 / clock_mhz
        boards = VirtualBoards(robot, position_known=True, tick_s=self.tick_s)
        self.machine = boards.machine
        self.acted = []
        self.machine.add = self._noted(self.machine.add)
        lines = dict(zip(("first", "second"), boards.lines, strict=True))
        begin_s = self.clock()
        settings = {"port": "first", "second_port": "second", "settle_s": 0.05}
        self.session = MotionSession(
            MC68HC11(
                ROBOT,
                settings,
                clock=self.clock,
                open_port=lambda url, _: Port(lines[url], self.clock, begin_s),
                pause=self.clock.advance,
            )
        )
        self.penetration = Penetration(self.session)
        self.session.connect()
        self.until(lambda: self.session.snapshot().phase is Phase.READY)

    def _noted(self, add):
        def noted(steps):
            self.acted.append(self.machine.command_origin + steps * self.machine.step)
            add(steps)

        return noted

    def run(self, seconds):
        for number in range(round(seconds / ROUND_S)):
            self.clock.advance(ROUND_S)
            self.session.run_once()
            if number % 2 == 0:
                self.penetration.step(self.clock())

    def until(self, condition, limit_s=60.0):
        end_s = self.clock() + limit_s
        while not condition():
            assert self.clock() < end_s, self.session.snapshot()
            self.run(0.005)

    def leave(self, phases):
        """Live on while a penetration is in one of these phases."""
        self.until(lambda: self.penetration.status.phase not in phases)

    def go_to(self, **targets):
        self.session.go_to(targets)
        self.run(0.05)
        self.until(lambda: self.session.snapshot().activity is DeviceState.IDLE)
        self.run(1.0)

    def began(self, column):
        """Return the look at which an axis began the latest motion of all that acted."""
        moved = np.flatnonzero(np.diff(np.concatenate(self.acted)[:, column]))
        rested = np.flatnonzero(np.diff(moved) > REST_S / self.tick_s)
        return (moved[rested[-1] + 1] if len(rested) else moved[0]) * round(self.tick_s / LOOK_S)

    def tip(self):
        """Return the nominal robot's joints (n, axes) under what acted since the list was empty."""
        looks = round(self.tick_s / LOOK_S)
        commands = np.repeat(np.concatenate(self.acted), looks, axis=0)
        plant = Plant.of(ROBOT)
        time_s = np.arange(len(commands)) * LOOK_S
        motion, _ = plant.advance(plant.at_rest(0.0, commands[0]), time_s, commands)
        return motion.position


@pytest.mark.parametrize("clock", CLOCKS)
def test_recentring_on_boards(clock):
    bench = Bench(clock)
    bench.go_to(zn=32.5e-6 + AWAY)
    session, chain = bench.session, Chain.of(ROBOT)
    plan = plan_recentring(chain, session.snapshot().command, session.setpoint_period_s)
    bench.acted.clear()
    session.play(plan.trajectory)
    bench.run(0.5)
    bench.until(lambda: session.snapshot().activity is DeviceState.IDLE)
    tip = tip_position(chain, bench.tip()[:, [list(ROBOT.axes).index(one) for one in JOINTS]])
    strayed = 1e9 * np.abs(tip - tip[0]).max(axis=0)
    print(
        f"re-centring, {clock} MHz: {plan.trajectory.duration_s:.1f} s, set-points of "
        f"{1e3 * session.setpoint_period_s:g} ms; tip strays {strayed[2]:.0f} nm along z "
        f"(planned {1e9 * plan.strayed_m[2]:.0f}), {strayed[:2].max():.0f} nm beside"
    )
    session.close()


@pytest.mark.parametrize("clock", CLOCKS)
def test_penetration_on_boards(clock):
    column = list(ROBOT.axes).index("zn")
    parameters = PenetrationParameters(depth_tolerance=0.2)
    plan = plan_thrust(ROBOT, parameters, 2e-3 / clock)
    delays, off, errors = [], [], []
    for place in 58e-6 + 1e-7 * np.arange(PLACES):
        cell = AxisEffect(axis="zn", id="contact", parameters={"place": place, "stiffness": -0.1})
        bench = Bench(clock, replace(ROBOT, effects=(cell,)))
        bench.go_to(zn=START)
        bench.penetration.arm(parameters, bench.clock())
        bench.penetration.press(bench.clock())
        bench.run(0.02)
        bench.leave(UNDER_WAY - {Step.CONTACT})
        bench.machine.set_effects(())  # a membrane that gives way: the free axis is judged
        bench.acted.clear()
        bench.leave({Step.CONTACT, Step.THRUST})
        bench.run(0.1)
        way, begin = bench.tip()[:, column], bench.began(column)
        bench.leave(UNDER_WAY)
        run = bench.penetration.status.run
        assert run.verdict is Verdict.DONE, run.reason
        delays.append(1e3 * run.contact_delay_s)
        off.append(1e6 * abs(run.contact - place))
        errors.append(error_of(plan, way, begin, parameters))
        bench.session.close()
    errors = 100.0 / parameters.depth * np.array(errors)
    print(
        f"penetration, {clock} MHz, {PLACES} places: contact found after {min(delays):.0f} to "
        f"{max(delays):.0f} ms, off by {np.median(off):.2f} µm (worst {max(off):.2f}); tip off its "
        f"profile by {errors.max():.2f} % of 50 µm"
    )


def error_of(plan, way, begin, parameters):
    """Return how far the tip leaves its profile, m, from the row on at which the device began."""
    since_s = LOOK_S * np.arange(len(way) - begin)
    whole = since_s < parameters.duration_s + 0.05
    wanted = plan.wanted.position(since_s[whole])
    return float(np.abs(way[begin] - way[begin:][whole] - np.abs(wanted)).max())
