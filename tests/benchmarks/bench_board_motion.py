"""Motion on virtual boards at both clocks: the true tip during re-centring and a penetration.

The program and the boards share a virtual clock, so that a busy machine changes nothing. The true
tip is simulated from the commands that took effect, also between ticks.
"""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.app.motion.penetration import (
    RUNNING_PHASES,
    PenetrationController,
    PenetrationParameters,
    PenetrationPhase,
    PenetrationVerdict,
)
from rotemina.app.motion.penetration.thrust import plan_thrust
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import SessionPhase
from rotemina.app.motion.teleoperation import plan_recentring
from rotemina.drivers.contract import DeviceState, VirtualClock
from rotemina.drivers.mc68hc11.driver import MC68HC11Driver
from rotemina.drivers.virtual_board import VirtualBoards
from rotemina.sim.kinematics import JOINTS, KinematicChain, compute_tip_position
from rotemina.sim.plant import Plant
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
# E clock of the chip.
CLOCKS = (4, 2)  # MHz
SAMPLE_S = 5e-5
LOOP_PERIOD_S = 2e-3
# A rest of this length separates the approach from the thrust.
REST_S = 0.05
# Start of zn above the cells, and number of penetrations.
START_M, PENETRATIONS = 64e-6, 8
# Distance of zn from mid-range before re-centring.
OFFSET_M = 31e-6
QUICK = {"PENETRATIONS": 1, "OFFSET_M": 2e-6}


class MemoryPort:
    """A serial line in memory."""

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
    """Session on boards; ``applied_commands`` are the commands (ticks, axes) that took effect."""

    def __init__(self, clock_mhz, robot=ROBOT):
        self.clock = VirtualClock(1.0)
        self.tick_s = 2e-3 / clock_mhz
        boards = VirtualBoards(robot, position_known=True, tick_s=self.tick_s)
        self.machine = boards.machine
        self.applied_commands = []
        self.machine.add_commands = self._record_commands(self.machine.add_commands)
        lines = dict(zip(("first", "second"), boards.host_ports, strict=True))
        begin_s = self.clock()
        settings = {"port": "first", "second_port": "second", "settle_s": 0.05}
        self.session = MotionSession(
            MC68HC11Driver(
                ROBOT,
                settings,
                clock=self.clock,
                open_port=lambda url, _: MemoryPort(lines[url], self.clock, begin_s),
                pause=self.clock.advance,
            )
        )
        self.penetration = PenetrationController(self.session)
        self.session.connect()
        self.wait_until(lambda: self.session.snapshot().phase is SessionPhase.READY)

    def _record_commands(self, add):
        def record_and_add(steps):
            self.applied_commands.append(
                self.machine.command_origin + steps * self.machine.step_size
            )
            add(steps)

        return record_and_add

    def run(self, seconds):
        for number in range(round(seconds / LOOP_PERIOD_S)):
            self.clock.advance(LOOP_PERIOD_S)
            self.session.run_once()
            if number % 2 == 0:
                self.penetration.step(self.clock())

    def wait_until(self, condition, limit_s=60.0):
        end_s = self.clock() + limit_s
        while not condition():
            assert self.clock() < end_s, self.session.snapshot()
            self.run(0.005)

    def wait_while_in(self, phases):
        """Let time pass while a penetration is in one of these phases."""
        self.wait_until(lambda: self.penetration.status.phase not in phases)

    def go_to(self, **targets):
        self.session.go_to(targets)
        self.run(0.05)
        self.wait_until(lambda: self.session.snapshot().activity is DeviceState.IDLE)
        self.run(1.0)

    def find_motion_start(self, column):
        """Return the sample at which an axis began its latest motion."""
        changes = np.flatnonzero(np.diff(np.concatenate(self.applied_commands)[:, column]))
        rests = np.flatnonzero(np.diff(changes) > REST_S / self.tick_s)
        return (changes[rests[-1] + 1] if len(rests) else changes[0]) * round(
            self.tick_s / SAMPLE_S
        )

    def simulate_joints(self):
        """Return the joints (n, axes) of the nominal robot under the applied commands."""
        samples_per_tick = round(self.tick_s / SAMPLE_S)
        commands = np.repeat(np.concatenate(self.applied_commands), samples_per_tick, axis=0)
        plant = Plant.of(ROBOT)
        time_s = np.arange(len(commands)) * SAMPLE_S
        motion, _ = plant.advance(plant.find_rest_state(0.0, commands[0]), time_s, commands)
        return motion.position


@pytest.mark.parametrize("clock", CLOCKS)
def test_recentring_on_boards(clock):
    bench = Bench(clock)
    bench.go_to(zn=32.5e-6 + OFFSET_M)
    session, chain = bench.session, KinematicChain.of(ROBOT)
    plan = plan_recentring(chain, session.snapshot().command, session.setpoint_period_s)
    bench.applied_commands.clear()
    session.play(plan.trajectory)
    bench.run(0.5)
    bench.wait_until(lambda: session.snapshot().activity is DeviceState.IDLE)
    tip = compute_tip_position(
        chain, bench.simulate_joints()[:, [list(ROBOT.axes).index(joint) for joint in JOINTS]]
    )
    deviation = 1e9 * np.abs(tip - tip[0]).max(axis=0)
    print(
        f"re-centring, {clock} MHz: {plan.trajectory.duration_s:.1f} s, set-points of "
        f"{1e3 * session.setpoint_period_s:g} ms; tip deviates by {deviation[2]:.0f} nm along z "
        f"(planned {1e9 * plan.max_deviation_m[2]:.0f}), {deviation[:2].max():.0f} nm sideways"
    )
    session.close()


@pytest.mark.parametrize("clock", CLOCKS)
def test_penetration_on_boards(clock):
    column = list(ROBOT.axes).index("zn")
    parameters = PenetrationParameters(depth_tolerance=0.2)
    plan = plan_thrust(ROBOT, parameters, 2e-3 / clock)
    delays, contact_errors, errors = [], [], []
    for cell_position in 58e-6 + 1e-7 * np.arange(PENETRATIONS):
        cell = AxisEffect(
            axis="zn", id="contact", parameters={"place": cell_position, "stiffness": -0.1}
        )
        bench = Bench(clock, replace(ROBOT, effects=(cell,)))
        bench.go_to(zn=START_M)
        bench.penetration.arm(parameters, bench.clock())
        bench.penetration.press_button(bench.clock())
        bench.run(0.02)
        bench.wait_while_in(RUNNING_PHASES - {PenetrationPhase.CONTACT})
        # The membrane gives way, so that the error of the free axis is measured.
        bench.machine.set_effects(())
        bench.applied_commands.clear()
        bench.wait_while_in({PenetrationPhase.CONTACT, PenetrationPhase.THRUST})
        bench.run(0.1)
        position, start = bench.simulate_joints()[:, column], bench.find_motion_start(column)
        bench.wait_while_in(RUNNING_PHASES)
        run = bench.penetration.status.run
        assert run.verdict is PenetrationVerdict.DONE, run.reason
        delays.append(1e3 * run.contact_delay_s)
        contact_errors.append(1e6 * abs(run.contact - cell_position))
        errors.append(compute_profile_error(plan, position, start, parameters))
        bench.session.close()
    errors = 100.0 / parameters.depth * np.array(errors)
    print(
        f"penetration, {clock} MHz, {PENETRATIONS} positions: contact found after "
        f"{min(delays):.0f} to "
        f"{max(delays):.0f} ms, off by {np.median(contact_errors):.2f} µm (worst "
        f"{max(contact_errors):.2f}); tip off the "
        f"profile by {errors.max():.2f} % of 50 µm"
    )


def compute_profile_error(plan, position, start, parameters):
    """Return the largest deviation, m, of the tip from its profile after the device started."""
    since_s = SAMPLE_S * np.arange(len(position) - start)
    is_thrust = since_s < parameters.duration_s + 0.05
    desired = plan.target_shape.position(since_s[is_thrust])
    return float(np.abs(position[start] - position[start:][is_thrust] - np.abs(desired)).max())
