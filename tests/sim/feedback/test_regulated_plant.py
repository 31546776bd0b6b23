"""Plants under controllers: compiled or sample by sample, whole or piece by piece, the same."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.feedback import regulated_plant
from rotemina.sim.feedback.controller import Controller
from rotemina.sim.feedback.errors import LostLoopError
from rotemina.sim.feedback.feed_forward import FeedForward
from rotemina.sim.feedback.gains import Gains, Notch, OutputLimits
from rotemina.sim.feedback.regulation import Regulation
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.robot.model import AxisEffect

H, ZN, THX = 2e-4, 5, 3
GAINS = Gains(proportional=0.05, integral=800.0, notch=Notch(420.0, 1.0, 0.025))
TILT = Gains(integral=400.0, notch=Notch(300.0, 1.0, 0.025))


@pytest.fixture(scope="module")
def machine(worn):
    slow = AxisEffect(axis="zn", id="amplifier_lag", parameters={"time_constant": 1e-4})
    return replace(worn, effects=(*worn.effects, slow))


def started(robot):
    plant = Plant.of(robot, closed_loop=True)
    middle = np.array([sum(axis.range) / 2.0 for axis in plant.robot.axes.values()])
    state = plant.at_rest(0.0, middle)
    gains = {ZN: ("zn", GAINS), THX: ("thx", TILT)}
    controllers = {
        index: Regulation(robot, name, own, 1 / H, peak_sensitivity=9.0).controller()
        for index, (name, own) in gains.items()
    }
    for index, one in controllers.items():
        one.start(float(state.position[-1, index]), float(middle[index]))
    reference = np.tile(state.position[-1], (300, 1))
    reference[:, ZN] += 5e-6 * np.sin(2 * np.pi * 40.0 * H * np.arange(300))
    command = np.tile(middle, (300, 1))
    command[:, 0] += 1e-6 * np.arange(300)
    return plant, state, command, reference, controllers


@pytest.mark.parametrize("pieces", [1, 3])
def test_all_ways_are_the_same(machine, pieces):
    found = []
    for way in (regulated_plant._compiled, regulated_plant._by_sample):
        plant, state, command, reference, controllers = started(machine)
        chance, parts = Chance(np.random.default_rng(4)), []
        for rows in np.array_split(np.arange(300), pieces):
            motion, state, asked = way(
                plant, state, H, command[rows], reference[rows], controllers, chance
            )
            state = replace(state, time_s=state.time_s - state.time_s[-1])
            parts.append(np.concatenate([motion.reading, motion.inputs, asked], axis=1))
        found.append(np.concatenate(parts))
    np.testing.assert_allclose(found[0], found[1], rtol=1e-9, atol=1e-13)
    assert np.ptp(found[0][:, 12 + ZN]) > 5e-6


def test_what_is_not_finite_leaves_the_output_as_it_was(worn):
    plant, state, command, reference, controllers = started(worn)
    reference[100:120, ZN] = np.nan
    _, _, asked = regulated_plant.advance(plant, state, H, command, reference, controllers)
    assert np.isfinite(asked).all()
    assert (asked[100:120, ZN] == asked[99, ZN]).all()


@pytest.mark.parametrize("way", [regulated_plant._compiled, regulated_plant._by_sample])
@pytest.mark.parametrize("gains", [Gains(), Gains(integral=3000.0)])
def test_a_loop_that_nothing_answers_is_given_up(worn, way, gains):
    plant, state, command, reference, _ = started(worn)
    controller = Controller(gains, H, OutputLimits(-1e-3, 1e-3), FeedForward((0.0,)))
    controller.start(float(state.position[-1, ZN]), float(command[0, ZN]))
    reference[:, ZN] += np.linspace(0.0, 15e-6, 300) if gains.integral == 0.0 else 0.0
    if gains.integral:  # far too much of it: it swings up
        reference[1:, ZN] += 1e-6
    command, reference = np.tile(command, (8, 1)), np.concatenate([reference] * 8)
    with pytest.raises(
        LostLoopError, match="axis zn: its loop was opened because the axis does not respond"
    ):
        way(plant, state, H, command, reference, {ZN: controller}, None)


def test_one_wrong_reading_is_none(worn):
    plant, state, command, reference, controllers = started(worn)
    reference[50:60, ZN] += 10e-6  # as 2 ms of outliers would look
    regulated_plant.advance(plant, state, H, command, reference, controllers)
