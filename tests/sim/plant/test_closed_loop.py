"""The sampled control loop, compared with a loop calculated step by step."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from rotemina.sim.errors import PlantError
from rotemina.sim.plant import Plant, simulate_nominal_response
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect, CascadeController
from rotemina.sim.robot_files import load_robot

EMPS = load_robot("emps")


def replace_controller_fields(**changes):
    axis = EMPS.axes["q"]
    return replace(EMPS, axes={"q": replace(axis, controller=replace(axis.controller, **changes))})


def simulate_stepwise(robot, time_s, command, add, delay_s):
    """Step the same loop on a grid ten times finer, with each input taken at its time."""
    axis, refinement = robot.axes["q"], 10
    loop, step = axis.controller, (time_s[1] - time_s[0]) / refinement
    dynamics = np.zeros((4, 4))
    dynamics[0, 1] = 1.0
    dynamics[1] = [0.0, -axis.damping, axis.gain, -axis.force_offset]
    dynamics[1] /= axis.mass
    transition = expm(dynamics * step)
    q, v, previous_position = command[0], 0.0, command[0]
    efforts, positions = [], []
    for k in range(len(time_s)):
        speed = (
            v
            if loop.velocity == "state" or k == 0
            else (q - previous_position) / (refinement * step)
        )
        effort = loop.kv * (loop.kp * (command[k] - q) - speed) + add[k]
        efforts.append(np.clip(effort, -loop.limit, loop.limit))
        positions.append(q)
        previous_position = q
        for j in range(refinement):
            effort_row = int(
                np.floor((k * refinement + j) / refinement - delay_s / (refinement * step) + 1e-9)
            )
            q, v, _, _ = transition @ [q, v, efforts[max(effort_row, 0)], 1.0]
    return np.array(positions), np.array(efforts)


@pytest.mark.parametrize(
    ("velocity", "delay_s"),
    [("state", 0.0), ("backward", 3e-4), ("state", 1e-3), ("backward", 2.4e-3)],
)
def test_the_loop_is_sampled_exactly(velocity, delay_s):
    robot = replace_controller_fields(velocity=velocity, delay_s=delay_s, kp=60.0)
    time_s = np.arange(400) * 1e-3
    command = 0.01 * np.sin(2 * np.pi * 3 * time_s) + 0.02
    add = np.where((time_s > 0.1) & (time_s < 0.15), 2.0, 0.0)
    record = Record.from_signals(
        time_s,
        {("q", Tap.CMD): command, ("q", Tap.ADD): add},
        {"q": "m"},
        {"mode": "closed_loop"},
    )
    response = simulate_nominal_response(robot, record)
    position, effort = simulate_stepwise(robot, time_s, command, add, delay_s)
    np.testing.assert_allclose(response.signal("q", Tap.REF), position, atol=1e-11)
    np.testing.assert_allclose(response.signal("q", Tap.U), effort, atol=1e-6)
    assert np.ptp(effort) > 1.0


def test_effort_stays_within_the_limit_and_reaches_it():
    time_s = np.arange(500) * 1e-3
    command = np.where(time_s > 0.1, 0.2, 0.0)
    record = Record.from_signals(
        time_s, {("q", Tap.CMD): command}, {"q": "m"}, {"mode": "closed_loop"}
    )
    effort = simulate_nominal_response(EMPS, record).signal("q", Tap.U)
    assert effort.max() == pytest.approx(10.0)
    assert effort.min() >= -10.0


@pytest.mark.parametrize("delay_s", [0.0, 1.7e-3])
def test_a_loop_in_pieces_equals_the_loop_at_once(delay_s):
    plant = Plant.of(replace_controller_fields(delay_s=delay_s), closed_loop=True)
    rng = np.random.default_rng(3)
    time_s = np.cumsum(rng.uniform(0.8e-3, 1.2e-3, 300))
    command = 0.05 + 0.01 * np.sin(20 * time_s)[:, None]
    whole, _ = plant.advance(plant.find_rest_state(time_s[0], command[0]), time_s, command)
    state, parts = plant.find_rest_state(time_s[0], command[0]), []
    for piece in (slice(0, 1), slice(1, 2), slice(2, 90), slice(90, 300)):
        motion, state = plant.advance(state, time_s[piece], command[piece])
        parts.append(motion.inputs)
    np.testing.assert_allclose(np.concatenate(parts), whole.inputs, atol=1e-7)


def test_an_effect_on_one_axis_does_not_change_the_controller_output_of_another():
    robot = load_robot("rotemina")
    loop = CascadeController(kind="cascade", kp=20.0, kv=100.0, limit=10.0, delay_s=2e-3)
    axes = {**robot.axes, "thx": replace(robot.axes["thx"], controller=loop)}
    without_effect = replace(robot, axes=axes)
    with_delay = replace(without_effect, effects=(AxisEffect(axis="zn", id="delay"),))
    time_s = np.arange(200) * 1e-3
    command = np.tile([sum(axis.range) / 2 for axis in axes.values()], (200, 1))
    command[50:, list(axes).index("thx")] *= 1.1
    efforts = []
    for robot in (without_effect, with_delay):
        plant = Plant.of(robot, closed_loop=True)
        motion, _ = plant.advance(plant.find_rest_state(0.0, command[0]), time_s, command)
        efforts.append(motion.inputs[:, list(axes).index("thx")])
    assert np.ptp(efforts[0]) > 0.0
    np.testing.assert_array_equal(efforts[1], efforts[0])


def test_a_force_axis_in_open_loop_needs_its_voltage():
    record = Record.from_signals(np.arange(3.0), {("q", Tap.CMD): np.zeros(3)}, {"q": "m"})
    with pytest.raises(PlantError, match=r"needs a q\.u column"):
        simulate_nominal_response(EMPS, record)


def test_a_force_axis_in_open_loop_follows_its_voltage():
    """The speed of a damped mass under constant force settles at (gain u − offset) / D."""
    time_s = np.arange(0, 3, 1e-3)
    voltage = np.full(len(time_s), 2.0)
    record = Record.from_signals(
        time_s, {("q", Tap.CMD): np.zeros(len(time_s)), ("q", Tap.U): voltage}, {"q": "m"}
    )
    axis = EMPS.axes["q"]
    final = (axis.gain * 2.0 - axis.force_offset) / axis.damping
    position = simulate_nominal_response(EMPS, record).signal("q", Tap.REF)
    lag = axis.mass / axis.damping
    exact = final * (time_s - lag * (1 - np.exp(-time_s / lag)))
    np.testing.assert_allclose(position, exact, atol=1e-11)
