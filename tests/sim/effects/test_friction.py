"""Friction: sticks exactly, slides as its equations say, starts as after a rise."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.io import loadmat

from rotemina.sim.effects.friction import SPRINGS, coulomb, lugre, springs
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot, parse_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.simulation.simulation import simulate

MASS, RATE = 2.0, 2 * np.pi * 10.0
STIFFNESS = MASS * RATE**2
DRY = 0.6  # N; deflects the axis by 76 µm
YIELD = DRY / STIFFNESS
EVERY = pytest.mark.parametrize("formulation", ["stribeck", "lugre"])


def one_axis(damping_ratio=0.02, kind="stepper"):
    gain = "gain = 1.0\n" if kind == "force" else ""
    return parse_robot(
        f"[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='{kind}'\nunit='m'\nrange=[0.0, 1.0]\n"
        f"{gain}mass={MASS}\ndamping={2 * damping_ratio * MASS * RATE}\nstiffness={STIFFNESS}\n"
    )


def friction(formulation, dry=DRY, **parameters):
    names = ("coulomb",) if formulation == "lugre" else ("coulomb_forward", "coulomb_backward")
    if formulation == "lugre":
        parameters.setdefault("deflection", 1e-7)
    parameters.update(dict.fromkeys(names, dry))
    return AxisEffect(axis="a", id="friction", formulation=formulation, parameters=parameters)


def driven(robot, effects, command, rate_hz=1000.0):
    time_s = np.arange(len(command)) / rate_hz
    signals = {("a", Tap.CMD): command}
    record = Record.from_signals(time_s, signals, {"a": "m"})
    return simulate(robot, effects, record).signal("a", Tap.REF)


@EVERY
def test_a_run_starts_as_after_a_slow_rise(formulation):
    rest = driven(one_axis(), [friction(formulation)], np.full(2000, 0.5))
    assert 0.5 - rest[0] == pytest.approx(YIELD, rel=1e-2)


@EVERY
@pytest.mark.parametrize("damping_ratio", [0.005, 0.15, 0.7])
def test_the_start_does_not_depend_on_the_damping_of_the_axis(formulation, damping_ratio):
    rest = driven(one_axis(damping_ratio), [friction(formulation)], np.full(2, 0.5))
    assert 0.5 - rest[0] == pytest.approx(YIELD, rel=2e-2)


@EVERY
def test_it_holds_without_drift_however_long(formulation):
    """Held at a reversal, with the input well inside the band in which it sticks."""
    command = np.concatenate([[0.5], np.full(50_000, 0.5 - 0.8 * YIELD)])
    held = driven(one_axis(), [friction(formulation)], command)[2000:]
    assert np.ptp(held) <= (1e-15 if formulation == "stribeck" else 1e-12)


def test_it_breaks_loose_at_the_static_force():
    slow = 0.5 + np.linspace(0.0, 8 * YIELD, 20_000)
    effect = friction("stribeck", static_ratio=2.0, stribeck_speed=1e-5)
    path = driven(one_axis(), [effect], slow)
    loose = np.flatnonzero(np.abs(path - path[0]) > 1e-9)[0]
    assert (slow[loose] - path[0]) / YIELD == pytest.approx(2.0, rel=1e-2)


def test_each_direction_has_its_own_friction():
    """In slow sliding the axis is behind by what friction of that direction takes."""
    up = np.linspace(0.0, 20 * YIELD, 20_000)
    effect = AxisEffect(
        axis="a",
        id="friction",
        parameters={"coulomb_forward": 0.6, "coulomb_backward": 0.2, "viscous_forward": 100.0},
    )
    path = driven(one_axis(0.1), [effect], 0.5 + np.concatenate([up, up[::-1]]))
    speed = 20 * YIELD / 20.0
    own = 2 * 0.1 / RATE * speed
    behind = 0.5 + up[-1] - path[19_999]
    assert behind == pytest.approx((0.6 + 100.0 * speed) / STIFFNESS + own, rel=1e-2)
    assert path[-1] - 0.5 == pytest.approx(0.2 / STIFFNESS + own, rel=1e-2)


@EVERY
def test_stick_slip_comes_at_low_speed_and_not_at_high(formulation):
    def stuck_share(speed):
        command = 0.5 + speed * np.arange(8000) / 1000.0
        effect = friction(formulation, static_ratio=2.5, stribeck_speed=1e-3)
        velocity = np.diff(driven(one_axis(0.1), [effect], command)[4000:]) * 1000.0
        return np.mean(np.abs(velocity) < 0.02 * speed)

    assert stuck_share(1e-4) > 0.5
    assert stuck_share(4e-2) == 0.0


@EVERY
def test_it_damps_ringing_in_steps_of_four_yields_a_period(formulation):
    """Free decay under dry friction alone: 4 F/k less from peak to peak."""
    command = np.concatenate([[0.5], np.full(1500, 0.5 + 40 * YIELD)])
    path = driven(one_axis(0.0), [friction(formulation)], command, 4000.0) - command[-1]
    peaks = path[1:-1][(path[1:-1] > path[:-2]) & (path[1:-1] >= path[2:]) & (path[1:-1] > YIELD)]
    np.testing.assert_allclose(np.diff(peaks[:3]), -4 * YIELD, rtol=3e-2)


def test_presliding_is_a_spring_with_hysteresis():
    """Far below breaking loose LuGre yields in series with the axis, and nearly comes back."""
    share = 10.0  # of the bristles' yield over the axis'
    effect = friction("lugre", deflection=share * YIELD)
    turn = 0.5 - np.concatenate([np.full(200, 3 * YIELD), np.full(20_000, 2.9 * YIELD)])
    path = driven(one_axis(0.2), [effect], np.concatenate([[0.5], turn]))
    moved = path[-1] - path[199]
    assert 0.0 < moved < 0.1 * YIELD * 1.3
    stuck = driven(one_axis(0.2), [friction("stribeck")], np.concatenate([[0.5], turn]))
    assert abs(stuck[-1] - stuck[-10_000]) < 1e-12


def lugre_by_integration(command, rate_hz, deflection, ratio, speed):
    """Return the path of LuGre as published, but with the damping that fades with speed."""
    stiff = DRY / deflection
    loss = 2 * 0.5 * np.sqrt(stiff * MASS)

    def slope(u):
        def rates(_t, y):
            q, v, z = y
            g = 1 + (ratio - 1) * np.exp(-((v / speed) ** 2))
            zdot = v - abs(v) * z / (deflection * g)
            fade = loss / (1 + loss * abs(v) / (DRY * g))
            force = -stiff * z - fade * zdot
            return [v, (STIFFNESS * (u - q) + force) / MASS, zdot]

        return rates

    plant = Plant.of(replace(one_axis(0.0), effects=(friction("lugre", deflection=deflection,
                     static_ratio=ratio, stribeck_speed=speed),)))  # fmt: skip
    state = plant.at_rest(0.0, command[:1])
    y = np.array([*state.x, *state.memory])
    path = [y[0]]
    for u in command[:-1]:
        y = solve_ivp(slope(u), (0, 1 / rate_hz), y, method="LSODA", rtol=1e-8, atol=1e-12).y[:, -1]
        path.append(y[0])
    return np.array(path)


def test_lugre_follows_its_differential_equation():
    deflection, ratio, speed = YIELD, 1.5, 2e-3
    command = 0.5 + 6 * YIELD * np.sin(2 * np.pi * 1.3 * np.arange(400) / 200.0)
    expected = lugre_by_integration(command, 200.0, deflection, ratio, speed)
    effect = friction("lugre", deflection=deflection, static_ratio=ratio, stribeck_speed=speed)
    path = driven(one_axis(0.0), [effect], command, 200.0)
    gap = np.sqrt(np.mean((path - expected) ** 2)) / np.sqrt(np.mean((expected - command) ** 2))
    assert gap < 0.04


@EVERY
def test_without_dry_and_viscous_friction_nothing_changes(formulation):
    command = 0.5 + 0.1 * np.sin(2 * np.pi * 3 * np.arange(2000) / 1000.0)
    path = driven(one_axis(), [friction(formulation, dry=0.0)], command)
    np.testing.assert_allclose(path, driven(one_axis(), (), command), rtol=0, atol=1e-10)


@pytest.mark.parametrize("deflection", [1e-8, 1e-5, 1e-2])
def test_lugre_is_stable_at_any_stiffness_of_the_bristles(deflection):
    command = 0.5 + 1e-3 * np.sin(2 * np.pi * 3 * np.arange(2000) / 1000.0)
    effect = friction("lugre", deflection=deflection, static_ratio=3.0, bristle_damping=2.0)
    assert np.abs(driven(one_axis(), [effect], command) - 0.5).max() < 2e-3


def test_stiff_bristles_are_dry_friction():
    command = 0.5 + 1e-3 * np.sin(2 * np.pi * 3 * np.arange(2000) / 1000.0)
    lag = [
        driven(one_axis(), [friction(name)], command) - command for name in ("stribeck", "lugre")
    ]
    assert np.sqrt(np.mean((lag[0] - lag[1]) ** 2)) < 0.02 * np.std(lag[0])


def test_an_axis_that_a_force_moves_starts_at_its_command():
    """Its input does not tell where it rests."""
    command = np.full(3, 0.4)
    signals = {("a", Tap.CMD): command, ("a", Tap.U): np.zeros(3)}
    record = Record.from_signals(np.arange(3) * 1e-3, signals, {"a": "m"})
    path = simulate(one_axis(kind="force"), [friction("stribeck", 1e-5)], record)
    assert path.signal("a", Tap.REF)[0] == pytest.approx(0.4, abs=1e-12)


@pytest.mark.parametrize(
    ("step", "numbers", "states"),
    [
        (coulomb, [1.0, 0.5, 2.0, 0.1, 0.3, 0.2], []),
        (lugre, [1e3, 1e-3, 0.5, 0.1, 20.0, 20.0, 0.3], [2e-4]),
    ],
)
def test_the_force_is_against_motion_and_grows_with_it(step, numbers, states):
    """As plain Python: odd but for the directions' own figures, and never more than it may be."""
    for free in np.linspace(0.01, 5.0, 200):
        force = step(0.0, free, 0.0, 1e-3, 5e-7, 1e-3, numbers, list(states))
        assert force < 0.0
        left = free + 1e-3 * force
        assert left >= 0.0


def ball_screw(damping, effect):
    """The measured axis with the published mass, viscous and dry friction."""
    robot = load_robot("emps")
    axis = replace(robot.axes["q"], mass=95.11, damping=damping, force_offset=-3.16)
    return replace(robot, axes={"q": axis}, effects=(effect,))


def on_ball_screw(formulation):
    effect = friction(formulation, 20.39)
    figures = {"deflection": 1e-5} if formulation == "lugre" else {}
    return replace(effect, axis="q", parameters={**effect.parameters, **figures})


@EVERY
def test_a_free_axis_is_accurate_with_its_own_steps(formulation):
    """Under its position loop: the effort against that with steps fifty times as fine."""
    time_s = np.arange(4000) * 1e-3
    command = 0.1 + 0.05 * (1 - np.cos(2 * np.pi * 0.5 * time_s))
    plant = Plant.of(ball_screw(203.5, on_ball_screw(formulation)), closed_loop=True)
    efforts = []
    for step_s in (plant.assembly.inner_step_s, 1e-5):
        stepped = replace(plant, assembly=replace(plant.assembly, inner_step_s=step_s))
        state = stepped.at_rest(0.0, command[:1])
        efforts.append(stepped.advance(state, time_s, command[:, None])[0].inputs)
    assert np.linalg.norm(efforts[0] - efforts[1]) < 2e-3 * np.linalg.norm(efforts[1])


@EVERY
def test_a_measured_axis_is_simulated_far_better_with_friction(formulation, shared_dir):
    """EMPS, the record to fit: effort in closed loop, 17.3 % off without dry friction."""
    measured = loadmat(shared_dir / "data" / "emps" / "DATA_EMPS.mat")
    time_s, command, effort, read = (np.ravel(measured[key]) for key in ("t", "qg", "vir", "qm"))
    record = Record.from_signals(
        time_s,
        {("q", Tap.CMD): command, ("q", Tap.U): effort, ("q", Tap.MEAS): read},
        {"q": "m"},
        {"mode": "closed_loop", "history": "unknown"},
    )
    answer = nominal_response(ball_screw(203.5, on_ball_screw(formulation)), record)
    gap = np.linalg.norm(answer.signal("q", Tap.U) - effort) / np.linalg.norm(effort)
    assert gap < 0.047


def pulled(path):
    """Mean force, step by step, of springs that slip at L/8, 2L/8, … on a motion that is given."""
    numbers = (0.1, 0.5, 0.0, *(0.1 / (1e-6 * (i + 1)) for i in range(SPRINGS)))
    state, force = np.zeros(SPRINGS), []
    for step in np.diff(path, prepend=0.0):
        force.append(-springs(0.0, step / 1e-3, 0.0, 1e-3, 0.0, 0.0, numbers, state))
    return np.array(force)


def test_springs_slip_one_after_the_other_and_all_at_last():
    path = np.linspace(0.0, 12e-6, 121)
    force = pulled(path)
    slips = 1e-6 * np.arange(1, SPRINGS + 1)
    expected = 0.1 * np.minimum(path[:, None] / slips, 1.0).sum(axis=1)
    np.testing.assert_allclose(force[1:], (expected[1:] + expected[:-1]) / 2.0, atol=1e-12)
    back = np.linspace(12e-6, -1e-6, 131)
    assert pulled(np.concatenate([path, back]))[-1] == pytest.approx(-0.5 * 0.8)


def test_a_closed_loop_of_springs_is_forgotten():
    """Masing's rules: where a minor loop closes, the force is what it was, and goes on so."""
    out, back = np.linspace(0.0, 6e-6, 61), np.linspace(6e-6, 4.5e-6, 31)
    on = np.linspace(6e-6, 9e-6, 31)
    straight = pulled(np.concatenate([out, on]))
    looped = pulled(np.concatenate([out, back, back[::-1], on]))
    np.testing.assert_allclose(looped[-31:], straight[-31:], atol=1e-12)


def test_springs_hold_a_pushed_axis_back_to_what_their_force_allows():
    """The implicit solution is the one of the plastic limit: v + b f, all slipping."""
    numbers, state = (0.1, 1.0, 3.0, *(1e6 for _ in range(SPRINGS))), np.full(SPRINGS, 1e-7)
    force = springs(0.0, 5.0, 0.0, 1e-3, 0.0, 0.2, numbers, state)
    left = (5.0 - 0.2 * 0.8) / (1.0 + 0.2 * 3.0)
    assert force == pytest.approx(-(0.8 + 3.0 * left))
    np.testing.assert_allclose(state, 1e-7)
