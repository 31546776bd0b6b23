"""The sampled control loop, against a loop written out step by step."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from rotemina.sim.plant.errors import PlantError
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.response import nominal_response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect, CascadeController

EMPS = load_robot("emps")


def with_controller(**changes):
    axis = EMPS.axes["q"]
    return replace(EMPS, axes={"q": replace(axis, controller=replace(axis.controller, **changes))})


def written_out(robot, time_s, command, add, delay_s):
    """The same loop, stepped on a grid ten times finer, each input looked up by its time."""
    axis, fine = robot.axes["q"], 10
    loop, step = axis.controller, (time_s[1] - time_s[0]) / fine
    generator = np.zeros((4, 4))
    generator[0, 1] = 1.0
    generator[1] = [0.0, -axis.damping, axis.gain, -axis.force_offset]
    generator[1] /= axis.mass
    advance = expm(generator * step)
    q, v, before = command[0], 0.0, command[0]
    efforts, positions = [], []
    for k in range(len(time_s)):
        speed = v if loop.velocity == "state" or k == 0 else (q - before) / (fine * step)
        effort = loop.kv * (loop.kp * (command[k] - q) - speed) + add[k]
        efforts.append(np.clip(effort, -loop.limit, loop.limit))
        positions.append(q)
        before = q
        for j in range(fine):
            asked = int(np.floor((k * fine + j) / fine - delay_s / (fine * step) + 1e-9))
            q, v, _, _ = advance @ [q, v, efforts[max(asked, 0)], 1.0]
    return np.array(positions), np.array(efforts)


@pytest.mark.parametrize("velocity", ["state", "backward"])
@pytest.mark.parametrize("delay_s", [0.0, 3e-4, 1e-3, 2.4e-3])
def test_the_loop_is_sampled_exactly(velocity, delay_s):
    robot = with_controller(velocity=velocity, delay_s=delay_s, kp=60.0)
    time_s = np.arange(400) * 1e-3
    command = 0.01 * np.sin(2 * np.pi * 3 * time_s) + 0.02
    add = np.where((time_s > 0.1) & (time_s < 0.15), 2.0, 0.0)
    record = Record.from_signals(
        time_s,
        {("q", Tap.CMD): command, ("q", Tap.ADD): add},
        {"q": "m"},
        {"mode": "closed_loop"},
    )
    response = nominal_response(robot, record)
    position, effort = written_out(robot, time_s, command, add, delay_s)
    np.testing.assert_allclose(response.signal("q", Tap.REF), position, atol=1e-11)
    np.testing.assert_allclose(response.signal("q", Tap.U), effort, atol=1e-6)
    assert np.ptp(effort) > 1.0


def test_effort_stays_within_the_limit_and_reaches_it():
    time_s = np.arange(500) * 1e-3
    command = np.where(time_s > 0.1, 0.2, 0.0)
    record = Record.from_signals(
        time_s, {("q", Tap.CMD): command}, {"q": "m"}, {"mode": "closed_loop"}
    )
    effort = nominal_response(EMPS, record).signal("q", Tap.U)
    assert effort.max() == pytest.approx(10.0)
    assert effort.min() >= -10.0


@pytest.mark.parametrize("delay_s", [0.0, 3.3e-4, 1.7e-3])
def test_a_loop_in_pieces_is_the_loop_at_once(delay_s):
    plant = Plant.of(with_controller(delay_s=delay_s), closed_loop=True)
    rng = np.random.default_rng(3)
    time_s = np.cumsum(rng.uniform(0.8e-3, 1.2e-3, 300))
    command = 0.05 + 0.01 * np.sin(20 * time_s)[:, None]
    whole, _ = plant.advance(plant.at_rest(time_s[0], command[0]), time_s, command)
    state, parts = plant.at_rest(time_s[0], command[0]), []
    for piece in (slice(0, 1), slice(1, 2), slice(2, 90), slice(90, 300)):
        motion, state = plant.advance(state, time_s[piece], command[piece])
        parts.append(motion.inputs)
    np.testing.assert_allclose(np.concatenate(parts), whole.inputs, atol=1e-7)


def test_electronics_of_one_axis_leave_the_output_of_another_as_its_controller_gave_it():
    robot = load_robot("rotemina")
    loop = CascadeController(kind="cascade", kp=20.0, kv=100.0, limit=10.0, delay_s=2e-3)
    axes = {**robot.axes, "thx": replace(robot.axes["thx"], controller=loop)}
    bare = replace(robot, axes=axes)
    late = replace(bare, effects=(AxisEffect(axis="zn", id="delay"),))
    time_s = np.arange(200) * 1e-3
    command = np.tile([sum(axis.range) / 2 for axis in axes.values()], (200, 1))
    command[50:, list(axes).index("thx")] *= 1.1
    efforts = []
    for one in (bare, late):
        plant = Plant.of(one, closed_loop=True)
        motion, _ = plant.advance(plant.at_rest(0.0, command[0]), time_s, command)
        efforts.append(motion.inputs[:, list(axes).index("thx")])
    assert np.ptp(efforts[0]) > 0.0
    np.testing.assert_array_equal(efforts[1], efforts[0])


def test_a_force_axis_open_loop_needs_its_voltage():
    record = Record.from_signals(np.arange(3.0), {("q", Tap.CMD): np.zeros(3)}, {"q": "m"})
    with pytest.raises(PlantError, match=r"needs a q\.u column"):
        nominal_response(EMPS, record)


def test_a_force_axis_open_loop_moves_as_its_voltage_says():
    """Constant force on a damped mass: the speed settles at (gain u − offset) / D."""
    time_s = np.arange(0, 3, 1e-3)
    voltage = np.full(len(time_s), 2.0)
    record = Record.from_signals(
        time_s, {("q", Tap.CMD): np.zeros(len(time_s)), ("q", Tap.U): voltage}, {"q": "m"}
    )
    axis = EMPS.axes["q"]
    final = (axis.gain * 2.0 - axis.force_offset) / axis.damping
    position = nominal_response(EMPS, record).signal("q", Tap.REF)
    lag = axis.mass / axis.damping
    exact = final * (time_s - lag * (1 - np.exp(-time_s / lag)))
    np.testing.assert_allclose(position, exact, atol=1e-11)
