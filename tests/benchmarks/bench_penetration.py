"""A penetration's thrust of 50 µm on the simulator: the true tip against its profile.

Limits: 1 % of the stroke on the nominal robot with input shaping, 10 % with hysteresis 12 %, creep
2 % per decade and sensor noise. *Its profile* is the commanded motion of the tip (shaped, if input
shaping is on), from the tick at which the device started. *Raw* is the greatest distance at any
time. *Without lag* is the distance without a constant lag that is known in advance: half a tick
for the held command, and 2ζ/ω of the axis. The true tip is the motion of the axis at 20 times the
tick rate, without its sensor. There is no cell, so that the free robot is measured.
"""

from dataclasses import replace

import numpy as np

from rotemina.app.motion.penetration import (
    PenetrationController,
    PenetrationParameters,
    PenetrationPhase,
)
from rotemina.app.motion.penetration.thrust import find_resonance, plan_thrust
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.contract import DeviceState, VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.plant import Plant
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
TICK_S, SAMPLES_PER_TICK = 1e-3, 20
# A rest of this number of ticks separates the approach from the thrust.
REST_TICKS = 50
AXIS, COLUMN, START_M = "zn", 5, 64e-6
CELL = AxisEffect(axis=AXIS, id="contact", parameters={"place": 60e-6, "stiffness": -0.3})
HYSTERESIS = AxisEffect(axis=AXIS, id="hysteresis", parameters={"width": 0.12 * 65e-6})
CREEP = AxisEffect(axis=AXIS, id="creep", parameters={"rate": 0.02})
WORN_EFFECTS = (HYSTERESIS, CREEP)
# The default parameters.
DEFAULT_CASE = "S-curve, 90 ms, ZVD"
CASES = {
    "S-curve, 90 ms, unshaped": PenetrationParameters(shaping="none"),
    DEFAULT_CASE: PenetrationParameters(),
    "S-curve, 90 ms, inverse": PenetrationParameters(shaping="inverse"),
    "minimum jerk, 90 ms, ZVD": PenetrationParameters(shape="minimum_jerk"),
    "minimum jerk, 90 ms, inverse": PenetrationParameters(shape="minimum_jerk", shaping="inverse"),
    "S-curve, 20 ms, unshaped": PenetrationParameters(duration_s=0.02, shaping="none"),
    "S-curve, 20 ms, ZVD": PenetrationParameters(duration_s=0.02),
    "S-curve, 20 ms, inverse": PenetrationParameters(duration_s=0.02, shaping="inverse"),
}


def run_thrust(parameters: PenetrationParameters, effects: tuple[AxisEffect, ...]) -> np.ndarray:
    """Run a penetration until it holds; return every command (n, axes) since the start.

    The cell is removed as soon as it is found.
    """
    clock = VirtualClock(1.0)
    session = MotionSession(Simulator(ROBOT, clock=clock))
    penetration = PenetrationController(session)

    def step(count: int) -> None:
        for _ in range(count):
            clock.advance(0.01)
            session.run_once()
            penetration.step(clock())

    session.connect()
    step(5)
    session.go_to({AXIS: START_M})
    step(100)
    assert session.snapshot().activity is DeviceState.IDLE
    session.service.set_effects([CELL])
    step(10)
    penetration.arm(parameters, clock())
    step(50)
    penetration.press_button(clock())
    while penetration.status.phase is not PenetrationPhase.CONTACT:
        step(1)
    session.service.set_effects(effects)
    while penetration.status.phase in (PenetrationPhase.CONTACT, PenetrationPhase.THRUST):
        step(1)
    step(20)
    return np.array(session.history.tail().command)


def compute_errors(
    parameters: PenetrationParameters, effects: tuple[AxisEffect, ...]
) -> tuple[float, float, float]:
    """Return the error of the true tip, m: raw, without the lag, and ringing at the end."""
    commands = run_thrust(parameters, effects)
    resonance = find_resonance(ROBOT, AXIS)
    assert resonance is not None
    plan = plan_thrust(ROBOT, parameters, TICK_S)
    plant = Plant.of(replace(ROBOT, effects=effects), closed_loop=True)
    fine_commands = np.repeat(commands, SAMPLES_PER_TICK, axis=0)
    time_s = np.arange(1, len(fine_commands) + 1) * TICK_S / SAMPLES_PER_TICK
    motion, _ = plant.advance(plant.find_rest_state(0.0, commands[0]), time_s, fine_commands)
    tip = motion.position[:, COLUMN]
    changes = np.flatnonzero(np.diff(commands[:, COLUMN]))
    rests = np.flatnonzero(np.diff(changes) > REST_TICKS)
    last_row_at_rest = changes[rests[-1] + 1]
    origin = last_row_at_rest * SAMPLES_PER_TICK
    since_s = time_s[origin:] - time_s[origin]
    position = tip[origin:] - tip[origin]
    lag_s = 0.0
    if parameters.shaping != "inverse":
        lag_s = 0.5 * TICK_S + resonance.damping_ratio / (np.pi * resonance.frequency_hz)
    is_thrust = since_s < parameters.duration_s + 0.05
    raw = np.abs(position - plan.target_shape.position(since_s))[is_thrust].max()
    without_lag = np.abs(position - plan.target_shape.position(since_s - lag_s))[is_thrust].max()
    tail = position[(since_s > parameters.duration_s + TICK_S) & is_thrust]
    return float(raw), float(without_lag), float(np.ptp(tail) / 2)


def test_the_true_tip_follows_its_profile() -> None:
    print("\ndeviation of the true tip from its profile, % of 50 µm:")
    print("raw (limit 1, worn 10) and without lag;")
    print("ringing, nm; speed, mm/s, mean and peak; error of the cubics, nm")
    print(f"{'':28} nominal              worn                  speed       cubics")
    for name, parameters in CASES.items():
        plan = plan_thrust(ROBOT, parameters, TICK_S)
        columns = ""
        for robot_state, effects, limit in (("nominal", (), 1.0), ("worn", WORN_EFFECTS, 10.0)):
            raw, without_lag, ringing = compute_errors(parameters, effects)
            share = 100.0 / parameters.depth
            columns += f" {share * raw:5.2f} {share * without_lag:5.2f} {1e9 * ringing:6.1f}  "
            assert name != DEFAULT_CASE or share * raw <= limit, robot_state
        print(
            f"{name:28}{columns} {1e3 * plan.average_speed:5.2f} {1e3 * plan.peak_speed:5.2f} "
            f" {1e9 * plan.fit_error:.2g}"
        )
