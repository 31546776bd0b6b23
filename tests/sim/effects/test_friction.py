"""Friction: it sticks exactly, slides according to its equations and starts as after a rise."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.io import loadmat

from rotemina.sim.effects.friction import SPRING_COUNT, compute_springs_force
from rotemina.sim.plant import Plant, simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot, parse_robot
from rotemina.sim.simulation import simulate

MASS, RATE = 2.0, 2 * np.pi * 10.0
STIFFNESS = MASS * RATE**2
COULOMB_N = 0.6  # N; deflects the axis by 76 µm
DEFLECTION_M = COULOMB_N / STIFFNESS
dry_formulations = pytest.mark.parametrize("formulation", ["stribeck", "lugre"])


def make_robot(damping_ratio=0.02, kind="stepper"):
    gain = "gain = 1.0\n" if kind == "force" else ""
    return parse_robot(
        f"[robot]\nname='one'\naxes=['a']\n[axis.a]\nkind='{kind}'\nunit='m'\nrange=[0.0, 1.0]\n"
        f"{gain}mass={MASS}\ndamping={2 * damping_ratio * MASS * RATE}\nstiffness={STIFFNESS}\n"
    )


def make_friction(formulation, coulomb=COULOMB_N, **parameters):
    names = ("coulomb",) if formulation == "lugre" else ("coulomb_forward", "coulomb_backward")
    if formulation == "lugre":
        parameters.setdefault("deflection", 1e-7)
    parameters.update(dict.fromkeys(names, coulomb))
    return AxisEffect(axis="a", id="friction", formulation=formulation, parameters=parameters)


def simulate_position(robot, effects, command, rate_hz=1000.0):
    time_s = np.arange(len(command)) / rate_hz
    signals = {("a", Tap.CMD): command}
    record = Record.from_signals(time_s, signals, {"a": "m"})
    return simulate(robot, effects, record).signal("a", Tap.REF)


@dry_formulations
@pytest.mark.parametrize("damping_ratio", [0.005, 0.7])
def test_a_run_starts_as_after_a_slow_rise_with_any_damping(formulation, damping_ratio):
    position = simulate_position(
        make_robot(damping_ratio), [make_friction(formulation)], np.full(2, 0.5)
    )
    assert 0.5 - position[0] == pytest.approx(DEFLECTION_M, rel=2e-2)


@dry_formulations
def test_a_sticking_axis_does_not_drift(formulation):
    """The axis sticks after a reversal, with the input well within the sticking band."""
    command = np.concatenate([[0.5], np.full(50_000, 0.5 - 0.8 * DEFLECTION_M)])
    position = simulate_position(make_robot(), [make_friction(formulation)], command)[2000:]
    assert np.ptp(position) <= (1e-15 if formulation == "stribeck" else 1e-12)


def test_the_axis_breaks_loose_at_the_static_force():
    command = 0.5 + np.linspace(0.0, 8 * DEFLECTION_M, 20_000)
    effect = make_friction("stribeck", static_ratio=2.0, stribeck_speed=1e-5)
    path = simulate_position(make_robot(), [effect], command)
    breakaway_row = np.flatnonzero(np.abs(path - path[0]) > 1e-9)[0]
    assert (command[breakaway_row] - path[0]) / DEFLECTION_M == pytest.approx(2.0, rel=1e-2)


def test_each_direction_has_its_own_friction():
    """In slow sliding the axis lags by the friction of its direction over the stiffness."""
    up = np.linspace(0.0, 20 * DEFLECTION_M, 20_000)
    effect = AxisEffect(
        axis="a",
        id="friction",
        parameters={"coulomb_forward": 0.6, "coulomb_backward": 0.2, "viscous_forward": 100.0},
    )
    path = simulate_position(make_robot(0.1), [effect], 0.5 + np.concatenate([up, up[::-1]]))
    speed = 20 * DEFLECTION_M / 20.0
    damping_lag = 2 * 0.1 / RATE * speed
    lag = 0.5 + up[-1] - path[19_999]
    assert lag == pytest.approx((0.6 + 100.0 * speed) / STIFFNESS + damping_lag, rel=1e-2)
    assert path[-1] - 0.5 == pytest.approx(0.2 / STIFFNESS + damping_lag, rel=1e-2)


@dry_formulations
def test_stick_slip_occurs_at_low_speed_only(formulation):
    def compute_sticking_share(speed):
        command = 0.5 + speed * np.arange(8000) / 1000.0
        effect = make_friction(formulation, static_ratio=2.5, stribeck_speed=1e-3)
        velocity = np.diff(simulate_position(make_robot(0.1), [effect], command)[4000:]) * 1000.0
        return np.mean(np.abs(velocity) < 0.02 * speed)

    assert compute_sticking_share(1e-4) > 0.5
    assert compute_sticking_share(4e-2) == 0.0


@dry_formulations
def test_ringing_decays_by_four_deflections_per_period(formulation):
    """In free decay under dry friction only, each peak is 4 F/k lower than the one before."""
    command = np.concatenate([[0.5], np.full(1500, 0.5 + 40 * DEFLECTION_M)])
    path = (
        simulate_position(make_robot(0.0), [make_friction(formulation)], command, 4000.0)
        - command[-1]
    )
    peaks = path[1:-1][
        (path[1:-1] > path[:-2]) & (path[1:-1] >= path[2:]) & (path[1:-1] > DEFLECTION_M)
    ]
    np.testing.assert_allclose(np.diff(peaks[:3]), -4 * DEFLECTION_M, rtol=3e-2)


def integrate_lugre(command, rate_hz, deflection, ratio, speed):
    """Return the path of the published LuGre model, with damping that decreases with speed."""
    bristle_stiffness = COULOMB_N / deflection
    bristle_damping = 2 * 0.5 * np.sqrt(bristle_stiffness * MASS)

    def make_derivatives(u):
        def compute_derivatives(_t, y):
            q, v, z = y
            g = 1 + (ratio - 1) * np.exp(-((v / speed) ** 2))
            zdot = v - abs(v) * z / (deflection * g)
            damping = bristle_damping / (1 + bristle_damping * abs(v) / (COULOMB_N * g))
            force = -bristle_stiffness * z - damping * zdot
            return [v, (STIFFNESS * (u - q) + force) / MASS, zdot]

        return compute_derivatives

    plant = Plant.of(replace(make_robot(0.0), effects=(make_friction("lugre", deflection=deflection,
                     static_ratio=ratio, stribeck_speed=speed),)))  # fmt: skip
    state = plant.find_rest_state(0.0, command[:1])
    y = np.array([*state.x, *state.memory])
    path = [y[0]]
    for u in command[:-1]:
        y = solve_ivp(
            make_derivatives(u), (0, 1 / rate_hz), y, method="LSODA", rtol=1e-8, atol=1e-12
        ).y[:, -1]
        path.append(y[0])
    return np.array(path)


def test_lugre_follows_its_differential_equation():
    deflection, ratio, speed = DEFLECTION_M, 1.5, 2e-3
    command = 0.5 + 6 * DEFLECTION_M * np.sin(2 * np.pi * 1.3 * np.arange(400) / 200.0)
    expected = integrate_lugre(command, 200.0, deflection, ratio, speed)
    effect = make_friction("lugre", deflection=deflection, static_ratio=ratio, stribeck_speed=speed)
    path = simulate_position(make_robot(0.0), [effect], command, 200.0)
    gap = np.sqrt(np.mean((path - expected) ** 2)) / np.sqrt(np.mean((expected - command) ** 2))
    assert gap < 0.04


@pytest.mark.parametrize("deflection", [1e-8, 1e-2])
def test_lugre_is_stable_at_any_stiffness_of_the_bristles(deflection):
    command = 0.5 + 1e-3 * np.sin(2 * np.pi * 3 * np.arange(2000) / 1000.0)
    effect = make_friction("lugre", deflection=deflection, static_ratio=3.0, bristle_damping=2.0)
    assert np.abs(simulate_position(make_robot(), [effect], command) - 0.5).max() < 2e-3


def test_a_force_axis_starts_at_its_command():
    """Its input does not determine where it rests."""
    command = np.full(3, 0.4)
    signals = {("a", Tap.CMD): command, ("a", Tap.U): np.zeros(3)}
    record = Record.from_signals(np.arange(3) * 1e-3, signals, {"a": "m"})
    response = simulate(make_robot(kind="force"), [make_friction("stribeck", 1e-5)], record)
    assert response.signal("a", Tap.REF)[0] == pytest.approx(0.4, abs=1e-12)


def make_emps_robot(damping, effect):
    """Return the EMPS robot with the published mass, viscous friction and this effect."""
    robot = load_robot("emps")
    axis = replace(robot.axes["q"], mass=95.11, damping=damping, force_offset=-3.16)
    return replace(robot, axes={"q": axis}, effects=(effect,))


def make_emps_friction(formulation):
    effect = make_friction(formulation, 20.39)
    extra_parameters = {"deflection": 1e-5} if formulation == "lugre" else {}
    return replace(effect, axis="q", parameters={**effect.parameters, **extra_parameters})


@dry_formulations
def test_the_preset_steps_of_a_force_axis_are_accurate(formulation):
    """Under its position loop, the effort matches that with much finer steps."""
    time_s = np.arange(4000) * 1e-3
    command = 0.1 + 0.05 * (1 - np.cos(2 * np.pi * 0.5 * time_s))
    plant = Plant.of(make_emps_robot(203.5, make_emps_friction(formulation)), closed_loop=True)
    efforts = []
    for step_s in (plant.assembly.inner_step_s, 1e-5):
        stepped = replace(plant, assembly=replace(plant.assembly, inner_step_s=step_s))
        state = stepped.find_rest_state(0.0, command[:1])
        efforts.append(stepped.advance(state, time_s, command[:, None])[0].inputs)
    assert np.linalg.norm(efforts[0] - efforts[1]) < 2e-3 * np.linalg.norm(efforts[1])


@dry_formulations
def test_friction_reduces_the_gap_of_the_measured_emps_axis(formulation, shared_dir):
    """EMPS training record: without dry friction, the closed-loop effort deviates by 17.3 %."""
    data = loadmat(shared_dir / "data" / "emps" / "DATA_EMPS.mat")
    time_s, command, effort, reading = (np.ravel(data[key]) for key in ("t", "qg", "vir", "qm"))
    record = Record.from_signals(
        time_s,
        {("q", Tap.CMD): command, ("q", Tap.U): effort, ("q", Tap.MEAS): reading},
        {"q": "m"},
        {"mode": "closed_loop", "history": "unknown"},
    )
    response = simulate_nominal_response(
        make_emps_robot(203.5, make_emps_friction(formulation)), record
    )
    gap = np.linalg.norm(response.signal("q", Tap.U) - effort) / np.linalg.norm(effort)
    assert gap < 0.047


def compute_spring_forces(path):
    """Return the mean force in each step of springs that slip at L/8, 2L/8, … on this path."""
    numbers = (0.1, 0.5, 0.0, *(0.1 / (1e-6 * (i + 1)) for i in range(SPRING_COUNT)))
    state, force = np.zeros(SPRING_COUNT), []
    for step in np.diff(path, prepend=0.0):
        force.append(-compute_springs_force(0.0, step / 1e-3, 0.0, 1e-3, 0.0, 0.0, numbers, state))
    return np.array(force)


def test_springs_slip_one_after_the_other():
    path = np.linspace(0.0, 12e-6, 121)
    force = compute_spring_forces(path)
    slips = 1e-6 * np.arange(1, SPRING_COUNT + 1)
    expected = 0.1 * np.minimum(path[:, None] / slips, 1.0).sum(axis=1)
    np.testing.assert_allclose(force[1:], (expected[1:] + expected[:-1]) / 2.0, atol=1e-12)
    back = np.linspace(12e-6, -1e-6, 131)
    assert compute_spring_forces(np.concatenate([path, back]))[-1] == pytest.approx(-0.5 * 0.8)


def test_springs_forget_a_closed_minor_loop():
    """Masing's rules: after a minor loop closes, the force continues as without the loop."""
    out, back = np.linspace(0.0, 6e-6, 61), np.linspace(6e-6, 4.5e-6, 31)
    onwards = np.linspace(6e-6, 9e-6, 31)
    direct_force = compute_spring_forces(np.concatenate([out, onwards]))
    force_after_loop = compute_spring_forces(np.concatenate([out, back, back[::-1], onwards]))
    np.testing.assert_allclose(force_after_loop[-31:], direct_force[-31:], atol=1e-12)


def test_slipping_springs_decelerate_a_pushed_axis_by_their_full_force():
    """The implicit solution is that of the plastic limit, where all springs slip: v + b f."""
    numbers, state = (
        (0.1, 1.0, 3.0, *(1e6 for _ in range(SPRING_COUNT))),
        np.full(SPRING_COUNT, 1e-7),
    )
    force = compute_springs_force(0.0, 5.0, 0.0, 1e-3, 0.0, 0.2, numbers, state)
    velocity_after = (5.0 - 0.2 * 0.8) / (1.0 + 0.2 * 3.0)
    assert force == pytest.approx(-(0.8 + 3.0 * velocity_after))
    np.testing.assert_allclose(state, 1e-7)
