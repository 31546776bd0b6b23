"""A penetration's thrust of 50 µm on the simulator: the true tip against its profile.

The limits: 1 % of the stroke on the nominal robot with input shaping, 10 % with hysteresis 12 %,
creep 2 % per decade and sensor noise. *Its profile* is the one that was asked of the tip (shaped,
where input shaping is on), from the tick at which the device began; *raw* is the greatest distance
at any time, *but for the lag* that after a constant lag, known beforehand, is taken off: half a
tick for the command that is held, and 2ζ/ω of the axis. The true tip is the motion of the axis,
20 times a tick, without its sensor; the free robot has no cell, so that it is judged alone.
"""

from dataclasses import replace

import numpy as np

from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.penetration import Penetration
from rotemina.app.motion.penetration.status import Phase
from rotemina.app.motion.penetration.thrust import plan_thrust, resonance_of
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.plant.plant import Plant
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")
TICK_S, FINE = 1e-3, 20
REST = 50  # ticks without motion part the approach from the thrust
AXIS, COLUMN, START = "zn", 5, 64e-6
CELL = AxisEffect(axis=AXIS, id="contact", parameters={"place": 60e-6, "stiffness": -0.3})
HYSTERESIS = AxisEffect(axis=AXIS, id="hysteresis", parameters={"width": 0.12 * 65e-6})
CREEP = AxisEffect(axis=AXIS, id="creep", parameters={"rate": 0.02})
WORN = (HYSTERESIS, CREEP)
USUAL = "S-curve, 90 ms, ZVD"  # the parameters as they are shipped
CASES = {
    "S-curve, 90 ms, unshaped": PenetrationParameters(shaping="none"),
    USUAL: PenetrationParameters(),
    "S-curve, 90 ms, inverse": PenetrationParameters(shaping="inverse"),
    "minimum jerk, 90 ms, ZVD": PenetrationParameters(shape="minimum_jerk"),
    "minimum jerk, 90 ms, inverse": PenetrationParameters(shape="minimum_jerk", shaping="inverse"),
    "S-curve, 20 ms, unshaped": PenetrationParameters(duration_s=0.02, shaping="none"),
    "S-curve, 20 ms, ZVD": PenetrationParameters(duration_s=0.02),
    "S-curve, 20 ms, inverse": PenetrationParameters(duration_s=0.02, shaping="inverse"),
}


def thrust(parameters: PenetrationParameters, effects: tuple[AxisEffect, ...]) -> np.ndarray:
    """Run a penetration until it holds; return every command (n, axes) since the start.

    The cell is there until it is found; then it gives way.
    """
    clock = VirtualClock(1.0)
    session = MotionSession(Simulator(ROBOT, clock=clock))
    penetration = Penetration(session)

    def step(times: int) -> None:
        for _ in range(times):
            clock.advance(0.01)
            session.run_once()
            penetration.step(clock())

    session.connect()
    step(5)
    session.go_to({AXIS: START})
    step(100)
    assert session.snapshot().activity is DeviceState.IDLE
    session.service.set_effects([CELL])
    step(10)
    penetration.arm(parameters, clock())
    step(50)
    penetration.press(clock())
    while penetration.status.phase is not Phase.CONTACT:
        step(1)
    session.service.set_effects(effects)
    while penetration.status.phase in (Phase.CONTACT, Phase.THRUST):
        step(1)
    step(20)
    return np.array(session.history.tail().command)


def error_of(
    parameters: PenetrationParameters, effects: tuple[AxisEffect, ...]
) -> tuple[float, float, float]:
    """Return the error of the true tip, m: raw, but for the lag, and what rings at the end."""
    commands = thrust(parameters, effects)
    resonance = resonance_of(ROBOT, AXIS)
    assert resonance is not None
    plan = plan_thrust(ROBOT, parameters, TICK_S)
    plant = Plant.of(replace(ROBOT, effects=effects), closed_loop=True)
    fine = np.repeat(commands, FINE, axis=0)
    time_s = np.arange(1, len(fine) + 1) * TICK_S / FINE
    motion, _ = plant.advance(plant.at_rest(0.0, commands[0]), time_s, fine)
    tip = motion.position[:, COLUMN]
    moved = np.flatnonzero(np.diff(commands[:, COLUMN]))
    apart = np.flatnonzero(np.diff(moved) > REST)
    first = moved[apart[-1] + 1]  # the last row before the thrust
    origin = first * FINE
    since_s = time_s[origin:] - time_s[origin]
    way = tip[origin:] - tip[origin]
    lag_s = 0.0
    if parameters.shaping != "inverse":
        lag_s = 0.5 * TICK_S + resonance.damping_ratio / (np.pi * resonance.frequency_hz)
    whole = since_s < parameters.duration_s + 0.05
    raw = np.abs(way - plan.wanted.position(since_s))[whole].max()
    late = np.abs(way - plan.wanted.position(since_s - lag_s))[whole].max()
    tail = way[(since_s > parameters.duration_s + TICK_S) & whole]
    return float(raw), float(late), float(np.ptp(tail) / 2)


def test_the_true_tip_follows_its_profile() -> None:
    print("\ntrue tip off its profile, % of 50 µm: raw (limit 1, worn 10) and without lag;")
    print("ringing, nm; speed, mm/s, mean and peak; error of the cubics, nm")
    print(f"{'':28} nominal              worn                  speed       cubics")
    for name, parameters in CASES.items():
        plan = plan_thrust(ROBOT, parameters, TICK_S)
        columns = ""
        for machine, effects, limit in (("nominal", (), 1.0), ("worn", WORN, 10.0)):
            raw, late, rings = error_of(parameters, effects)
            share = 100.0 / parameters.depth
            columns += f" {share * raw:5.2f} {share * late:5.2f} {1e9 * rings:6.1f}  "
            assert name != USUAL or share * raw <= limit, machine
        print(
            f"{name:28}{columns} {1e3 * plan.average_speed:5.2f} {1e3 * plan.peak_speed:5.2f} "
            f" {1e9 * plan.fit_error:.2g}"
        )
