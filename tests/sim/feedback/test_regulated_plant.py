"""Plants with controllers: equal results compiled and by sample, whole and in pieces."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.errors import LostLoopError
from rotemina.sim.feedback import (
    AxisRegulation,
    ControllerGains,
    FeedForward,
    NotchFilter,
    SampledController,
    regulated_plant,
)
from rotemina.sim.feedback.gains import OutputLimits
from rotemina.sim.plant import Plant, RandomStreams
from rotemina.sim.robot import AxisEffect

SAMPLE_S, ZN, THX = 2e-4, 5, 3
GAINS = ControllerGains(proportional=0.05, integral=800.0, notch=NotchFilter(420.0, 1.0, 0.025))
TILT_GAINS = ControllerGains(integral=400.0, notch=NotchFilter(300.0, 1.0, 0.025))


@pytest.fixture(scope="module")
def machine(worn_robot):
    lag = AxisEffect(axis="zn", id="amplifier_lag", parameters={"time_constant": 1e-4})
    return replace(worn_robot, effects=(*worn_robot.effects, lag))


def start_loop(robot):
    plant = Plant.of(robot, closed_loop=True)
    middle = np.array([sum(axis.range) / 2.0 for axis in plant.robot.axes.values()])
    state = plant.find_rest_state(0.0, middle)
    gains = {ZN: ("zn", GAINS), THX: ("thx", TILT_GAINS)}
    controllers = {
        index: AxisRegulation(
            robot, name, axis_gains, 1 / SAMPLE_S, peak_sensitivity=9.0
        ).make_controller()
        for index, (name, axis_gains) in gains.items()
    }
    for index, controller in controllers.items():
        controller.start(float(state.position[-1, index]), float(middle[index]))
    reference = np.tile(state.position[-1], (300, 1))
    reference[:, ZN] += 5e-6 * np.sin(2 * np.pi * 40.0 * SAMPLE_S * np.arange(300))
    command = np.tile(middle, (300, 1))
    command[:, 0] += 1e-6 * np.arange(300)
    return plant, state, command, reference, controllers


@pytest.mark.parametrize("pieces", [1, 3])
def test_compiled_and_sampled_loops_give_the_same(machine, pieces):
    results = []
    for advance in (regulated_plant._advance_compiled, regulated_plant._advance_by_sample):
        plant, state, command, reference, controllers = start_loop(machine)
        streams, parts = RandomStreams(np.random.default_rng(4)), []
        for rows in np.array_split(np.arange(300), pieces):
            motion, state, outputs = advance(
                plant, state, SAMPLE_S, command[rows], reference[rows], controllers, streams
            )
            state = replace(state, time_s=state.time_s - state.time_s[-1])
            parts.append(np.concatenate([motion.reading, motion.inputs, outputs], axis=1))
        results.append(np.concatenate(parts))
    np.testing.assert_allclose(results[0], results[1], rtol=1e-9, atol=1e-13)
    assert np.ptp(results[0][:, 12 + ZN]) > 5e-6


def test_the_output_stays_the_same_while_a_reference_is_not_finite(worn_robot):
    plant, state, command, reference, controllers = start_loop(worn_robot)
    reference[100:120, ZN] = np.nan
    _, _, outputs = regulated_plant.advance(plant, state, SAMPLE_S, command, reference, controllers)
    assert np.isfinite(outputs).all()
    assert (outputs[100:120, ZN] == outputs[99, ZN]).all()


@pytest.mark.parametrize(
    "advance", [regulated_plant._advance_compiled, regulated_plant._advance_by_sample]
)
@pytest.mark.parametrize("gains", [ControllerGains(), ControllerGains(integral=3000.0)])
def test_a_loop_is_opened_if_the_axis_does_not_respond(worn_robot, advance, gains):
    plant, state, command, reference, _ = start_loop(worn_robot)
    controller = SampledController(gains, SAMPLE_S, OutputLimits(-1e-3, 1e-3), FeedForward((0.0,)))
    controller.start(float(state.position[-1, ZN]), float(command[0, ZN]))
    reference[:, ZN] += np.linspace(0.0, 15e-6, 300) if gains.integral == 0.0 else 0.0
    if gains.integral:  # so large that the loop oscillates
        reference[1:, ZN] += 1e-6
    command, reference = np.tile(command, (8, 1)), np.concatenate([reference] * 8)
    with pytest.raises(
        LostLoopError, match="axis zn: its loop was opened because the axis does not respond"
    ):
        advance(plant, state, SAMPLE_S, command, reference, {ZN: controller}, None)


def test_a_few_wrong_readings_do_not_open_the_loop(worn_robot):
    plant, state, command, reference, controllers = start_loop(worn_robot)
    reference[50:60, ZN] += 10e-6  # like 2 ms of outliers
    regulated_plant.advance(plant, state, SAMPLE_S, command, reference, controllers)
