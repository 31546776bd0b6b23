"""The generator's machine without parts is the nominal plant, and each part has its effect."""

from itertools import pairwise

import numpy as np
import pytest

from rotemina.sim.blind import SimulationRun, build_machine
from rotemina.sim.blind.actuator import draw_creep, draw_hysteresis, draw_lost_steps
from rotemina.sim.blind.filters import delay_smooth_signal
from rotemina.sim.blind.force import ForceLoop, run_loop
from rotemina.sim.blind.loads import (
    draw_backlash,
    draw_contact,
    draw_flexible_mode,
    draw_friction,
    draw_stiffness_nonlinearity,
)
from rotemina.sim.blind.machine import SampledCommands
from rotemina.sim.blind.mechanics import (
    LOAD_ROW_LENGTH,
    SLIP,
    compute_hardening_share,
    compute_load_force,
)
from rotemina.sim.blind.preisach import draw_plane, run_plane
from rotemina.sim.blind.sensing import draw_encoder_interpolation, draw_sensor_lag
from rotemina.sim.plant import simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")


def make_machine(names, commands):
    columns = zip(names, commands.values.T, strict=True)
    travels = {name: np.array([column.min(), column.max()]) for name, column in columns}
    return build_machine(ROBOT, names, travels)


def make_stepper_commands(*positions_mm):
    """Moves of 0.3 s, each followed by a hold of 0.3 s; the first position is held throughout."""
    positions_mm_with_start = [positions_mm[0], *positions_mm]
    moves = [
        np.concatenate([np.linspace(a, b, 300), np.full(300, b)])
        for a, b in pairwise(positions_mm_with_start)
    ]
    column = np.concatenate(moves) * 1e-3
    others = np.full((len(column), 2), 0.03)
    return SampledCommands(1e-3, np.column_stack([column, others]))


def make_piezo_commands(shares, step_s=1e-3):
    spans = [ROBOT.axes[name].span for name in ("thx", "thy", "zn")]
    return SampledCommands(step_s, np.outer(shares, spans))


def make_swing(count=3000, frequency_hz=1.3, step_s=1e-3):
    return 0.5 - 0.3 * np.cos(2.0 * np.pi * frequency_hz * np.arange(count) * step_s)


@pytest.mark.parametrize("names", [("x", "y", "z"), ("thx", "thy", "zn")])
def test_a_machine_without_parts_is_the_nominal_plant(names):
    rng = np.random.default_rng(4)
    shares = make_swing(2000)[:, None] + 0.01 * rng.normal(size=(2000, 3))
    values = shares * [1e-3 if name in "xyz" else ROBOT.axes[name].span for name in names]
    commands = SampledCommands(1e-3, values)
    signals = {(name, Tap.CMD): values[:, i] for i, name in enumerate(names)}
    record = Record.from_signals(
        np.arange(2000) * 1e-3, signals, {name: ROBOT.unit(name) for name in names}
    )
    nominal = simulate_nominal_response(ROBOT, record)
    response = make_machine(names, commands).respond(commands, 0)
    for i, name in enumerate(names):
        gap = response.reading[:, i] - nominal.signal(name, Tap.MEAS)
        assert np.abs(gap).max() < 1e-3 * ROBOT.axes[name].sensor.noise_floor


def test_a_loop_without_imperfections_is_the_nominal_loop():
    robot = load_robot("emps")
    x = np.minimum(np.arange(3000) / 1500.0, 1.0)
    command = 0.02 + 0.1 * x**3 * (10.0 - 15.0 * x + 6.0 * x**2)
    record = Record.from_signals(
        np.arange(3000) * 1e-3, {("q", Tap.CMD): command}, {"q": "m"}, {"mode": "closed_loop"}
    )
    nominal = simulate_nominal_response(robot, record)
    u, reading = run_loop(
        robot.axes["q"], ForceLoop(np.zeros(LOAD_ROW_LENGTH)), command, np.zeros(3000)
    )
    assert np.abs(u - nominal.signal("q", Tap.U)).max() < 1e-6
    assert np.abs(reading - nominal.signal("q", Tap.MEAS)).max() < 1e-10


@pytest.fixture
def stepper_axis():
    return make_machine(("x", "y", "z"), make_stepper_commands(30.0, 30.1)).axes[0]


@pytest.fixture
def piezo_axis():
    return make_machine(("thx", "thy", "zn"), make_piezo_commands(make_swing())).axes[0]


def test_a_preisach_plane_forgets_turning_points_that_were_passed():
    plane = draw_plane(np.random.default_rng(1))
    out = run_plane(plane, np.array([0.0, 1.0, 0.3, 0.6, 0.4, 0.6, 0.8, 1.0, 0.0]))
    assert out[0] == 0.0
    assert out[1] == pytest.approx(1.0)
    assert out[5] == pytest.approx(out[3])  # a minor loop closes
    assert out[7] == pytest.approx(out[1])
    assert out[8] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_a_flexure_hardens_over_its_whole_range(piezo_axis, seed):
    part = draw_stiffness_nonlinearity(piezo_axis, np.random.default_rng(seed))
    row = part.act(np.zeros(1), SimulationRun(1e-4, 1, 0, 0), 0.3)
    positions = np.linspace(piezo_axis.low, piezo_axis.low + piezo_axis.span, 201)
    force = np.array([compute_hardening_share(row, q) for q in positions])
    curvature = np.diff(force, 2) * np.sign(positions[1:-1] - row[3])
    assert np.all(np.diff(force) >= 0.0)
    assert np.all(curvature >= -1e-9 * np.ptp(force))


@pytest.mark.parametrize("seed", range(2))
def test_hysteresis_has_the_width_of_its_size_at_any_rate(piezo_axis, seed):
    part = draw_hysteresis(piezo_axis, np.random.default_rng(seed))
    ramp = np.concatenate([np.linspace(0, 1, 801), np.linspace(1, 0, 801)])
    ramp = piezo_axis.low + piezo_axis.span * np.concatenate([ramp, ramp])
    out = part.act(ramp, SimulationRun(5e-5, 20, 0, 0), 0.1)
    assert np.allclose(part.act(ramp[::2], SimulationRun(5e-5, 20, 0, 0), 0.1), out[::2], atol=1e-7)
    up, down = out[1602 : 1602 + 801], out[1602 + 801 :][::-1]
    assert 0.02 < np.max(down - up) / piezo_axis.span < 0.25


def test_creep_starts_from_rest_and_adds_its_share_per_decade(piezo_axis):
    part = draw_creep(piezo_axis, np.random.default_rng(3))
    step_s = 1e-3
    values = np.where(np.arange(40_000) < 5000, 0.3, 0.7) * piezo_axis.span
    out = part.act(values, SimulationRun(step_s, 1, 2000, 0), 0.02) - values
    assert np.all(out[:5000] == 0.0)
    decade = out[5000 + 20_000] - out[5000 + 2000]
    assert decade / (0.4 * piezo_axis.span) == pytest.approx(0.02, rel=0.4)


def test_lost_steps_are_multiples_of_four_full_steps(stepper_axis):
    part = draw_lost_steps(stepper_axis, np.random.default_rng(0))
    run = SimulationRun(1e-3, 1, 100, 7)
    values = np.interp(np.arange(4000), [500, 600, 2000, 2100], [0.03, 0.031, 0.031, 0.03])
    lost = (values - part.act(values, run, 2.0)) / (4.0 * stepper_axis.full_step)
    assert np.allclose(lost, np.round(lost), atol=1e-6)
    assert len(np.unique(np.round(lost))) > 1
    assert np.array_equal(part.act(values, run, 2.0), part.act(values, run, 2.0))


@pytest.mark.parametrize("seed", range(2))
def test_the_axis_lags_by_half_the_backlash_width(seed):
    commands = make_stepper_commands(30.0, 30.02, 30.0, 30.02)
    nominal = make_machine(("x", "y", "z"), commands)
    part = draw_backlash(nominal.axes[0], np.random.default_rng(seed)).with_size(4e-6)
    lag = nominal.with_parts([part]).respond(commands, 0).motion[:, 0] - commands.values[:, 0]
    assert lag[590] == pytest.approx(-2e-6, rel=0.25)  # long after a rise
    assert lag[1190] == pytest.approx(-2e-6, rel=0.25)
    assert lag[1790] == pytest.approx(2e-6, rel=0.25)


@pytest.mark.parametrize("seed", range(2))
def test_a_dither_within_the_play_does_not_move_the_axis(stepper_axis, seed):
    rise = np.linspace(0.0, 30e-6, 2000)
    dither = 0.8e-6 * np.sin(np.linspace(0.0, 60.0 * np.pi, 6000))
    values = stepper_axis.low + np.concatenate([rise, 26.5e-6 + dither])  # away from the flank
    out = draw_backlash(stepper_axis, np.random.default_rng(seed)).act(
        values, SimulationRun(1e-3, 1, 0, 0), 8e-6
    )
    assert np.ptp(out[4000:]) < 1e-3 * 8e-6
    offset = values[2000:].mean() - out[4000:].mean()
    # The axis has not reached the position where a rise or a fall would leave it.
    assert abs(offset) < 4e-6


@pytest.mark.parametrize("speed", [1e-5, 2e-4, 1e-2])
def test_slip_elements_resist_with_their_stribeck_force_at_any_speed(speed):
    row, memory = np.zeros(LOAD_ROW_LENGTH), np.zeros(12)
    row[0], row[2:9] = SLIP, (40.0, 44.0, 1.4, 2e-4, 3e-7, 3e3, 0.0)
    for _ in range(20_000):
        force = compute_load_force(row, memory, 0.0, speed, 0, 5e-5)
    assert -force == pytest.approx(40.0 * (1.0 + 0.4 / (1.0 + (speed / 2e-4) ** 2)), rel=1e-6)
    for _ in range(20_000):
        force = compute_load_force(row, memory, 0.0, -speed, 0, 5e-5)
    assert force == pytest.approx(44.0 * (1.0 + 0.4 / (1.0 + (speed / 2e-4) ** 2)), rel=1e-6)


@pytest.mark.parametrize("seed", range(2))
def test_friction_deflects_the_axis_at_most_by_force_over_stiffness(stepper_axis, seed):
    commands = make_stepper_commands(30.0, 30.02, 30.0, 30.02)
    nominal = make_machine(("x", "y", "z"), commands)
    part = draw_friction(nominal.axes[0], np.random.default_rng(seed)).with_size(40.0)
    deviation = nominal.with_parts([part]).respond(commands, 0).motion[:, 0] - commands.values[:, 0]
    at_rest = np.abs(deviation[[590, 1190, 1790, 2390]])
    assert np.all(at_rest < 1.7 * 40.0 / stepper_axis.stiffness)
    assert np.ptp(deviation[[1190, 1790]]) > 0.2 * 40.0 / stepper_axis.stiffness


def test_contact_pushes_on_one_side_only(piezo_axis):
    commands = make_piezo_commands(make_swing())
    nominal = make_machine(("thx", "thy", "zn"), commands)
    part = draw_contact(nominal.axes[2], np.random.default_rng(1)).with_size(0.5)
    contact_position, side = part.act(np.zeros(0), SimulationRun(1e-3, 1, 0, 0), 0.5)[[2, 5]]
    gap = (
        nominal.with_parts([part]).respond(commands, 0).motion - nominal.respond(commands, 0).motion
    )[:, 2]
    free = side * (commands.values[:, 2] - contact_position) < -0.02 * piezo_axis.span
    touching = side * (commands.values[:, 2] - contact_position) > 0.05 * nominal.axes[2].span
    assert np.abs(gap[free]).max() < 1e-2 * np.abs(gap).max()
    assert np.all(side * gap[touching] < 0.0)


def test_a_flexible_mode_rings_and_keeps_the_static_gain(piezo_axis):
    commands = make_piezo_commands(np.repeat([0.3, 0.6], 2000))
    nominal = make_machine(("thx", "thy", "zn"), commands)
    part = draw_flexible_mode(nominal.axes[0], np.random.default_rng(1)).with_size(0.2)
    gap = (
        nominal.with_parts([part]).respond(commands, 0).motion - nominal.respond(commands, 0).motion
    )[:, 0]
    assert np.abs(gap[2000:2100]).max() > 100.0 * np.abs(gap[-50:]).max()


@pytest.mark.parametrize("seed", range(3))
def test_a_sensor_lags_a_ramp_by_its_lag_time(stepper_axis, seed):
    part = draw_sensor_lag(stepper_axis, np.random.default_rng(seed))
    ramp = np.arange(60_000) * 1e-8
    lag = ramp - part.act(ramp, SimulationRun(5e-5, 20, 0, 0), 2e-3)
    assert lag[-1] == pytest.approx(2e-3 / 5e-5 * 1e-8, rel=1e-3)


def test_the_encoder_error_has_the_period_of_the_grating(stepper_axis):
    part = draw_encoder_interpolation(stepper_axis, np.random.default_rng(0))
    position = np.linspace(0.0, 80e-6, 80_001)
    error = part.act(position, SimulationRun(1e-3, 1, 0, 0), 0.1) - position
    assert np.allclose(error[:40_000], error[40_000:80_000], atol=1e-12)
    assert 1e-8 < np.abs(error).max() < 3e-6


def test_a_delay_distorts_a_resonance_by_less_than_the_noise():
    time_s = np.arange(20_000) * 5e-5
    delayed = delay_smooth_signal(np.sin(2.0 * np.pi * 420.0 * time_s), np.full(20_000, 7.4))
    exact = np.sin(2.0 * np.pi * 420.0 * (time_s - 7.4 * 5e-5))
    assert np.abs(delayed - exact)[10:].max() < 1e-5
