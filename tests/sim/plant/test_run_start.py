"""How runs start: at rest under inputs, forces and controllers, steady, or as measured."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.plant.zero_order_hold import step_matrices
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot, parse_robot
from rotemina.sim.robot.model import AxisEffect, CascadeController
from rotemina.sim.simulation.simulation import simulate

ROBOT, EMPS = load_robot("rotemina"), load_robot("emps")


def held(robot, axis, command, *, mode="closed_loop", count=2000, rate=2000.0, **signals):
    time_s = np.arange(count) / rate
    taps = {(axis, Tap.CMD): np.full(count, command)} | {
        (axis, Tap(tap)): values for tap, values in signals.items()
    }
    record = Record.from_signals(time_s, taps, {axis: robot.axes[axis].unit}, {"mode": mode})
    return nominal_response(robot, record)


def test_a_force_axis_with_a_spring_starts_at_its_command():
    robot = replace(EMPS, axes={"q": replace(EMPS.axes["q"], stiffness=500.0, controller=None)})
    answer = held(robot, "q", 0.2, mode="open_loop", u=np.zeros(2000)).signal("q", Tap.REF)
    assert answer[0] == 0.2
    assert answer[-1] < 0.2  # nothing holds it there


@pytest.mark.parametrize(("limit", "saturated"), [(1e3, False), (5.0, True)])
def test_a_piezo_under_a_controller_starts_where_the_controller_holds_it(limit, saturated):
    loop = CascadeController(kind="cascade", kp=1e3, kv=1e5, limit=limit)
    axis = replace(ROBOT.axes["zn"], controller=loop, voltage_range=None)
    robot = replace(ROBOT, axes={**ROBOT.axes, "zn": axis})
    answer = held(robot, "zn", 5e-5, count=3)
    position, effort = answer.signal("zn", Tap.REF), answer.signal("zn", Tap.U)
    assert np.ptp(position) < 1e-12
    assert position[0] == pytest.approx(axis.gain * effort[0])
    asked = 1e3 * 1e5 * (5e-5 - position[0])
    assert effort[0] == pytest.approx(min(asked, limit))
    assert bool(asked > limit) is saturated


@pytest.mark.parametrize("limit", [150.0, 5.0])
@pytest.mark.parametrize(
    "effect",
    [
        {"id": "gain_error"},
        {"id": "hysteresis"},
        {"id": "static_nonlinearity"},
        {"id": "quantization"},
        {"id": "amplifier_lag"},
        {"id": "flexible_mode", "formulation": "parallel"},
    ],
    ids=lambda effect: effect["id"],
)
def test_a_controller_holds_an_axis_against_its_effects_from_the_first_row(effect, limit):
    loop = CascadeController(kind="cascade", kp=40.0, kv=60.0, limit=limit)
    axis = replace(ROBOT.axes["thx"], controller=loop, voltage_range=None)
    robot = replace(
        ROBOT,
        axes={**ROBOT.axes, "thx": axis},
        effects=(AxisEffect(axis="thx", **effect),),
    )
    command = axis.range[0] + 0.7 * axis.span
    answer = held(robot, "thx", command, count=200)
    position, effort = answer.signal("thx", Tap.REF), answer.signal("thx", Tap.U)
    assert np.ptp(position) < 1e-9 * axis.span
    asked = 40.0 * 60.0 * (command - position[0])
    if effect["id"] != "quantization":  # whose steps show in the output of its amplifier
        assert effort[0] == pytest.approx(min(asked, limit), rel=1e-9)


def test_the_part_behind_u_is_driven_by_the_measured_u_with_its_loop_open():
    voltage = np.full(2000, 1.0)
    time_s = np.arange(2000) * 1e-3
    signals = {("q", Tap.CMD): np.zeros(2000), ("q", Tap.U): voltage}
    record = Record.from_signals(time_s, signals, {"q": "m"}, {"mode": "closed_loop"})
    axis = EMPS.axes["q"]
    force, lag = axis.gain - axis.force_offset, axis.mass / axis.damping
    exact = force / axis.damping * (time_s - lag * (1 - np.exp(-time_s / lag)))
    answer = nominal_response(EMPS, record, drive=Tap.U)
    np.testing.assert_allclose(answer.signal("q", Tap.REF), exact, atol=1e-12)
    bare = Record.from_signals(
        time_s, {("q", Tap.CMD): np.zeros(2000)}, {"q": "m"}, {"mode": "closed_loop"}
    )
    with pytest.raises(PlantError, match=r"'q'.*needs a q\.u column"):
        nominal_response(EMPS, bare, drive=Tap.U)


def test_what_delays_the_amplifier_does_not_delay_its_measured_output():
    axis = ROBOT.axes["thx"]
    time_s = np.arange(400) / 2000.0
    command = axis.range[0] + axis.span * (0.5 + 0.1 * np.sin(2 * np.pi * 20.0 * time_s))
    late = AxisEffect(axis="thx", id="delay", parameters={"delay": 3 / 2000.0})
    commands = Record.from_signals(time_s, {("thx", Tap.CMD): command}, {"thx": "rad"})
    record = simulate(ROBOT, (late,), commands)
    answer = nominal_response(replace(ROBOT, effects=(late,)), record, drive=Tap.U)
    exact = record.signal("thx", Tap.REF)
    np.testing.assert_allclose(answer.signal("thx", Tap.REF), exact, rtol=0, atol=1e-12)


def test_a_weakly_damped_periodic_run_is_steady_from_its_first_row():
    robot = parse_robot(
        "[robot]\nname='r'\naxes=['a']\n[axis.a]\nkind='piezo'\nrange=[-1e-5,1e-5]\ngain=1e-6\n"
        "natural_frequency_hz=333.0\ndamping_ratio=5e-4\n"
    )
    period = 40  # 5 ms: the ringing falls by 0.5 % in a period
    command = 1e-6 * np.sign(np.sin(2 * np.pi * (np.arange(3 * period) + 0.5) / period))
    meta = {"history": "periodic", "period_samples": str(period)}
    time_s = np.arange(3 * period) / 8000
    record = Record.from_signals(time_s, {("a", Tap.CMD): command}, {"a": "m"}, meta)
    answer = nominal_response(robot, record).signal("a", Tap.REF)
    np.testing.assert_allclose(answer[:period], answer[-period:], atol=1e-10 * np.ptp(answer))


def test_a_periodic_run_under_a_controller_is_steady_too():
    period = 1000
    command = 0.05 + 0.01 * np.sin(2 * np.pi * np.arange(2 * period) / period)
    meta = {"history": "periodic", "period_samples": str(period), "mode": "closed_loop"}
    time_s = np.arange(2 * period) * 1e-3
    record = Record.from_signals(time_s, {("q", Tap.CMD): command}, {"q": "m"}, meta)
    effort = nominal_response(EMPS, record).signal("q", Tap.U)
    np.testing.assert_allclose(effort[:period], effort[period:], atol=1e-6)


def test_what_nothing_holds_has_no_steady_state():
    count = 100
    signals = {("q", Tap.CMD): np.zeros(count), ("q", Tap.U): np.zeros(count)}
    record = Record.from_signals(
        np.arange(count) * 1e-3, signals, {"q": "m"}, {"history": "periodic"}
    )
    with pytest.raises(PlantError, match="no steady state"):
        nominal_response(EMPS, record)


def test_axes_that_the_record_does_not_name_stay_where_they_are():
    text = (
        "[robot]\nname='r'\naxes=['q','p']\n"
        "[axis.q]\nkind='force'\nrange=[0,1]\ngain=30.0\nmass=2.0\ndamping=1.0\nforce_offset=9.0\n"
        "[axis.p]\nkind='piezo'\nunit='m'\nrange=[0,1e-4]\ngain=1e-6\nmass=1.0\ndamping=40.0\n"
        "stiffness=1e5\n[[coupling]]\nmatrix='M'\naxes=['q','p']\nvalue=0.1\n"
    )
    answer = held(parse_robot(text), "p", 5e-5, mode="open_loop").signal("p", Tap.REF)
    assert np.ptp(answer) < 1e-15


def test_only_what_hangs_together_is_simulated():
    assert Plant.of(ROBOT, only=["thx"]).axes == ("thx", "thy")
    assert Plant.of(ROBOT, only=["zn", "x"]).axes == ("x", "z", "zn")
    whole, part = Plant.of(ROBOT), Plant.of(ROBOT, only=["zn"])
    assert whole.axes == tuple(ROBOT.axes)
    rng = np.random.default_rng(0)
    command = np.array([sum(a.range) / 2 for a in ROBOT.axes.values()]) * (
        1 + 1e-3 * rng.standard_normal((50, 6))
    )
    time_s = np.arange(50) / 2000
    full, _ = whole.advance(whole.at_rest(0.0, command[0]), time_s, command)
    own = command[:, [2, 5]]
    some, _ = part.advance(part.at_rest(0.0, own[0]), time_s, own)
    np.testing.assert_allclose(some.position, full.position[:, [2, 5]], atol=1e-15)


@pytest.mark.parametrize("rate", [1000.0, 20_000.0])
def test_a_noisy_start_at_rest_does_not_make_the_model_ring(rate):
    rng = np.random.default_rng(1)
    axis = ROBOT.axes["thx"]
    time_s = np.arange(2000) / rate
    reading = 5e-4 + axis.sensor.noise_rms * rng.standard_normal(2000)
    signals = {("thx", Tap.CMD): np.full(2000, 5e-4), ("thx", Tap.MEAS): reading}
    record = Record.from_signals(time_s, signals, {"thx": "rad"}, {"history": "unknown"})
    answer = nominal_response(ROBOT, record).signal("thx", Tap.MEAS)
    assert np.abs(answer - 5e-4).max() < 1.5 * axis.sensor.noise_rms


def test_a_state_given_before_the_first_sample_moves_on_until_then():
    plant = Plant.of(ROBOT, only=["x"])
    start = plant.at_rest(0.0, np.array([0.02]))
    later, _ = plant.advance(start, np.array([0.5]), np.array([[0.03]]))
    assert later.position[0, 0] == pytest.approx(0.02)
    moving = plant.at(0.0, start.inputs[0], np.array([0.021]), np.array([0.0]))
    soon, _ = plant.advance(moving, np.array([1e-3]), np.array([[0.03]]))
    assert abs(soon.position[0, 0] - 0.021) > 1e-5


def test_samples_closer_than_rounding_are_refused():
    plant = Plant.of(EMPS, closed_loop=True)
    epoch = 1.7e9 + np.array([0.0, 2.4e-7, 4.8e-7])
    state = plant.at_rest(epoch[0], np.array([0.1]))
    with pytest.raises(PlantError, match="count time from the start"):
        plant.advance(state, epoch, np.full((3, 1), 0.1))


def test_uneven_steps_are_as_exact_as_single_ones():
    from scipy.linalg import expm

    lengths = np.random.default_rng(2).uniform(1e-5, 5e-3, 500)
    for group in Plant.of(ROBOT).groups + Plant.of(EMPS).groups:
        states, inputs = step_matrices(group, lengths)
        for index in range(0, 500, 25):
            exact = expm(lengths[index] * group.generator)[: 2 * group.size]
            scale = np.abs(exact).max(axis=1, keepdims=True)
            own = np.concatenate([states[index], inputs[index]], axis=1)
            assert (np.abs(own - exact) / scale).max() < 1e-12


@pytest.mark.parametrize("rest_m", [0.0220, 0.0240, 0.0275])
def test_an_axis_that_stands_still_does_not_keep_a_run_from_its_steady_state(rest_m):
    """What rounding does to a standing axis is no motion that has yet to settle."""
    robot = replace(load_robot("rotemina"), effects=(AxisEffect(axis="thx", id="hysteresis"),))
    time_s = np.arange(1000) / 1000.0
    signals = {
        ("thx", Tap.CMD): 6e-4 + 2e-4 * np.sin(2 * np.pi * 3.0 * time_s),
        ("x", Tap.CMD): np.full(1000, rest_m),
    }
    record = Record.from_signals(time_s, signals, {"thx": "rad", "x": "m"}, {"history": "periodic"})
    answer = nominal_response(robot, record).signal("thx", Tap.REF)
    assert np.ptp(answer) > 3e-4


def test_rest_is_the_same_at_any_time_and_is_found_once():
    """Under dry friction it is found by a simulation, which a fit would repeat for each record."""
    robot = replace(ROBOT, effects=(AxisEffect(axis="x", id="friction"),))
    plant = Plant.of(robot, only={"x"})
    command = np.array([0.02])
    early, late = plant.at_rest(0.0, command), plant.at_rest(7.5, command)
    assert (early.time_s[0], late.time_s[0]) == (0.0, 7.5)
    assert early.memory is late.memory
    assert early.x is late.x
    other = Plant.of(robot, only={"x"}).at_rest(7.5, command)
    np.testing.assert_array_equal(other.memory, late.memory)
