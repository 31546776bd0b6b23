"""The start of runs: at rest with inputs, forces and controllers, steady, or as measured."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from rotemina.sim.errors import PlantError
from rotemina.sim.plant import Plant, compute_step_matrices, simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect, CascadeController
from rotemina.sim.robot_files import load_robot, parse_robot
from rotemina.sim.simulation import simulate

ROBOT, EMPS = load_robot("rotemina"), load_robot("emps")


def simulate_constant_command(
    robot, axis, command, *, mode="closed_loop", count=2000, rate=2000.0, **signals
):
    time_s = np.arange(count) / rate
    taps = {(axis, Tap.CMD): np.full(count, command)} | {
        (axis, Tap(tap)): values for tap, values in signals.items()
    }
    record = Record.from_signals(time_s, taps, {axis: robot.axes[axis].unit}, {"mode": mode})
    return simulate_nominal_response(robot, record)


def test_a_force_axis_with_a_spring_starts_at_its_command():
    robot = replace(EMPS, axes={"q": replace(EMPS.axes["q"], stiffness=500.0, controller=None)})
    response = simulate_constant_command(
        robot, "q", 0.2, mode="open_loop", u=np.zeros(2000)
    ).signal("q", Tap.REF)
    assert response[0] == 0.2
    assert response[-1] < 0.2  # no force holds it there


@pytest.mark.parametrize(("limit", "is_saturated"), [(1e3, False), (5.0, True)])
def test_a_piezo_with_controller_starts_where_the_controller_holds_it(limit, is_saturated):
    loop = CascadeController(kind="cascade", kp=1e3, kv=1e5, limit=limit)
    axis = replace(ROBOT.axes["zn"], controller=loop, voltage_range=None)
    robot = replace(ROBOT, axes={**ROBOT.axes, "zn": axis})
    response = simulate_constant_command(robot, "zn", 5e-5, count=3)
    position, effort = response.signal("zn", Tap.REF), response.signal("zn", Tap.U)
    assert np.ptp(position) < 1e-12
    assert position[0] == pytest.approx(axis.gain * effort[0])
    ideal_effort = 1e3 * 1e5 * (5e-5 - position[0])
    assert effort[0] == pytest.approx(min(ideal_effort, limit))
    assert bool(ideal_effort > limit) is is_saturated


@pytest.mark.parametrize(
    ("effect_id", "limit"),
    [
        ("hysteresis", 150.0),
        ("hysteresis", 5.0),
        ("static_nonlinearity", 150.0),
        ("quantization", 150.0),
        ("amplifier_lag", 5.0),
        ("flexible_mode", 150.0),
    ],
)
def test_an_axis_with_effects_and_controller_is_at_rest_from_the_first_row(effect_id, limit):
    loop = CascadeController(kind="cascade", kp=40.0, kv=60.0, limit=limit)
    axis = replace(ROBOT.axes["thx"], controller=loop, voltage_range=None)
    robot = replace(
        ROBOT,
        axes={**ROBOT.axes, "thx": axis},
        effects=(AxisEffect(axis="thx", id=effect_id),),
    )
    command = axis.range[0] + 0.7 * axis.span
    response = simulate_constant_command(robot, "thx", command, count=200)
    position, effort = response.signal("thx", Tap.REF), response.signal("thx", Tap.U)
    assert np.ptp(position) < 1e-9 * axis.span
    ideal_effort = 40.0 * 60.0 * (command - position[0])
    if effect_id != "quantization":  # its steps show in the output of the amplifier
        assert effort[0] == pytest.approx(min(ideal_effort, limit), rel=1e-9)


def test_a_measured_u_drives_the_plant_with_its_loop_open():
    voltage = np.full(2000, 1.0)
    time_s = np.arange(2000) * 1e-3
    signals = {("q", Tap.CMD): np.zeros(2000), ("q", Tap.U): voltage}
    record = Record.from_signals(time_s, signals, {"q": "m"}, {"mode": "closed_loop"})
    axis = EMPS.axes["q"]
    force, lag = axis.gain - axis.force_offset, axis.mass / axis.damping
    exact = force / axis.damping * (time_s - lag * (1 - np.exp(-time_s / lag)))
    response = simulate_nominal_response(EMPS, record, drive=Tap.U)
    np.testing.assert_allclose(response.signal("q", Tap.REF), exact, atol=1e-12)
    without_u = Record.from_signals(
        time_s, {("q", Tap.CMD): np.zeros(2000)}, {"q": "m"}, {"mode": "closed_loop"}
    )
    with pytest.raises(PlantError, match=r"'q'.*needs a q\.u column"):
        simulate_nominal_response(EMPS, without_u, drive=Tap.U)


def test_an_amplifier_delay_does_not_delay_its_measured_output():
    axis = ROBOT.axes["thx"]
    time_s = np.arange(400) / 2000.0
    command = axis.range[0] + axis.span * (0.5 + 0.1 * np.sin(2 * np.pi * 20.0 * time_s))
    delay = AxisEffect(axis="thx", id="delay", parameters={"delay": 3 / 2000.0})
    commands = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    record = simulate(ROBOT, (delay,), commands)
    response = simulate_nominal_response(replace(ROBOT, effects=(delay,)), record, drive=Tap.U)
    exact = record.signal("thx", Tap.REF)
    np.testing.assert_allclose(response.signal("thx", Tap.REF), exact, rtol=0, atol=1e-12)


def test_a_weakly_damped_periodic_run_is_steady_from_its_first_row():
    robot = parse_robot(
        "[robot]\nname='r'\naxes=['a']\n[axis.a]\nkind='piezo'\nrange=[-1e-5,1e-5]\ngain=1e-6\n"
        "natural_frequency_hz=333.0\ndamping_ratio=5e-4\n"
    )
    period = 40  # 5 ms, in which the ringing decays by 0.5 %
    command = 1e-6 * np.sign(np.sin(2 * np.pi * (np.arange(3 * period) + 0.5) / period))
    meta = {"history": "periodic", "period_samples": str(period)}
    time_s = np.arange(3 * period) / 8000
    record = Record.from_signals(time_s, {("a", Tap.CMD): command}, {"a": "m"}, meta)
    response = simulate_nominal_response(robot, record).signal("a", Tap.REF)
    np.testing.assert_allclose(response[:period], response[-period:], atol=1e-10 * np.ptp(response))


def test_a_periodic_run_with_controller_is_steady():
    period = 1000
    command = 0.05 + 0.01 * np.sin(2 * np.pi * np.arange(2 * period) / period)
    meta = {"history": "periodic", "period_samples": str(period), "mode": "closed_loop"}
    time_s = np.arange(2 * period) * 1e-3
    record = Record.from_signals(time_s, {("q", Tap.CMD): command}, {"q": "m"}, meta)
    effort = simulate_nominal_response(EMPS, record).signal("q", Tap.U)
    np.testing.assert_allclose(effort[:period], effort[period:], atol=1e-6)


def test_a_free_axis_has_no_steady_state():
    count = 100
    signals = {("q", Tap.CMD): np.zeros(count), ("q", Tap.U): np.zeros(count)}
    record = Record.from_signals(
        np.arange(count) * 1e-3, signals, {"q": "m"}, {"history": "periodic"}
    )
    with pytest.raises(PlantError, match="no steady state"):
        simulate_nominal_response(EMPS, record)


def test_axes_without_commands_do_not_move():
    text = (
        "[robot]\nname='r'\naxes=['q','p']\n"
        "[axis.q]\nkind='force'\nrange=[0,1]\ngain=30.0\nmass=2.0\ndamping=1.0\nforce_offset=9.0\n"
        "[axis.p]\nkind='piezo'\nunit='m'\nrange=[0,1e-4]\ngain=1e-6\nmass=1.0\ndamping=40.0\n"
        "stiffness=1e5\n[[coupling]]\nmatrix='M'\naxes=['q','p']\nvalue=0.1\n"
    )
    response = simulate_constant_command(parse_robot(text), "p", 5e-5, mode="open_loop").signal(
        "p", Tap.REF
    )
    assert np.ptp(response) < 1e-15


def test_only_coupled_axes_are_simulated():
    assert Plant.of(ROBOT, only=["thx"]).axes == ("thx", "thy")
    assert Plant.of(ROBOT, only=["zn", "x"]).axes == ("x", "z", "zn")
    whole, part = Plant.of(ROBOT), Plant.of(ROBOT, only=["zn"])
    assert whole.axes == tuple(ROBOT.axes)
    rng = np.random.default_rng(0)
    command = np.array([sum(axis.range) / 2 for axis in ROBOT.axes.values()]) * (
        1 + 1e-3 * rng.standard_normal((50, 6))
    )
    time_s = np.arange(50) / 2000
    whole_motion, _ = whole.advance(whole.find_rest_state(0.0, command[0]), time_s, command)
    part_command = command[:, [2, 5]]
    part_motion, _ = part.advance(part.find_rest_state(0.0, part_command[0]), time_s, part_command)
    np.testing.assert_allclose(part_motion.position, whole_motion.position[:, [2, 5]], atol=1e-15)


def test_a_noisy_start_at_rest_does_not_make_the_model_ring():
    rate = 20_000.0
    rng = np.random.default_rng(1)
    axis = ROBOT.axes["thx"]
    time_s = np.arange(2000) / rate
    reading = 5e-4 + axis.sensor.noise_rms * rng.standard_normal(2000)
    signals = {("thx", Tap.CMD): np.full(2000, 5e-4), ("thx", Tap.MEAS): reading}
    record = Record.from_signals(time_s, signals, {"thx": "rad"}, {"history": "unknown"})
    response = simulate_nominal_response(ROBOT, record).signal("thx", Tap.MEAS)
    assert np.abs(response - 5e-4).max() < 1.5 * axis.sensor.noise_rms


def test_a_state_before_the_first_sample_advances_until_it():
    plant = Plant.of(ROBOT, only=["x"])
    start = plant.find_rest_state(0.0, np.array([0.02]))
    motion_from_rest, _ = plant.advance(start, np.array([0.5]), np.array([[0.03]]))
    assert motion_from_rest.position[0, 0] == pytest.approx(0.02)
    displaced = plant.make_state(0.0, start.inputs[0], np.array([0.021]), np.array([0.0]))
    motion_after_release, _ = plant.advance(displaced, np.array([1e-3]), np.array([[0.03]]))
    assert abs(motion_after_release.position[0, 0] - 0.021) > 1e-5


def test_samples_closer_than_rounding_are_refused():
    plant = Plant.of(EMPS, closed_loop=True)
    epoch = 1.7e9 + np.array([0.0, 2.4e-7, 4.8e-7])
    state = plant.find_rest_state(epoch[0], np.array([0.1]))
    with pytest.raises(PlantError, match="count time from the start"):
        plant.advance(state, epoch, np.full((3, 1), 0.1))


def test_matrices_of_uneven_steps_are_exact():
    lengths = np.random.default_rng(2).uniform(1e-5, 5e-3, 500)
    for group in Plant.of(ROBOT).groups + Plant.of(EMPS).groups:
        states, inputs = compute_step_matrices(group, lengths)
        for index in range(0, 500, 25):
            exact = expm(lengths[index] * group.generator)[: 2 * group.size]
            scale = np.abs(exact).max(axis=1, keepdims=True)
            matrices = np.concatenate([states[index], inputs[index]], axis=1)
            assert (np.abs(matrices - exact) / scale).max() < 1e-12


@pytest.mark.parametrize("rest_m", [0.0220, 0.0240, 0.0275])
def test_a_resting_axis_does_not_prevent_a_steady_state(rest_m):
    """Rounding errors of an axis at rest do not count as motion that must settle."""
    robot = replace(load_robot("rotemina"), effects=(AxisEffect(axis="thx", id="hysteresis"),))
    time_s = np.arange(1000) / 1000.0
    signals = {
        ("thx", Tap.CMD): 6e-4 + 2e-4 * np.sin(2 * np.pi * 3.0 * time_s),
        ("x", Tap.CMD): np.full(1000, rest_m),
    }
    record = Record.from_signals(time_s, signals, {"thx": "rad", "x": "m"}, {"history": "periodic"})
    response = simulate_nominal_response(robot, record).signal("thx", Tap.REF)
    assert np.ptp(response) > 3e-4


def test_the_rest_state_is_the_same_at_any_time_and_is_cached():
    """With dry friction it needs a simulation, which a fit would repeat for each record."""
    robot = replace(ROBOT, effects=(AxisEffect(axis="x", id="friction"),))
    plant = Plant.of(robot, only={"x"})
    command = np.array([0.02])
    first, second = plant.find_rest_state(0.0, command), plant.find_rest_state(7.5, command)
    assert (first.time_s[0], second.time_s[0]) == (0.0, 7.5)
    assert first.memory is second.memory
    assert first.x is second.x
    of_another_plant = Plant.of(robot, only={"x"}).find_rest_state(7.5, command)
    np.testing.assert_array_equal(of_another_plant.memory, second.memory)
