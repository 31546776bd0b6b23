"""The simulated loop: the engine's plant and the live controller, sample by sample."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.feedback.axis_loop import AxisLoop
from rotemina.sim.feedback.controller import Controller
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.feedback.feed_forward import FeedForward
from rotemina.sim.feedback.gains import Gains, Notch
from rotemina.sim.feedback.reference_lead import lead_taps
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect

RATE_HZ, H = 5000.0, 2e-4
TUNED = Gains(proportional=0.05, integral=800.0, notch=Notch(420.0, 1.0, 0.025))


def swing(rows=300):
    return 30e-6 + 10e-6 * np.sin(2 * np.pi * 20.0 * H * np.arange(rows))


def live(loop, reference, seed, feed_forward=None):
    """Drive the engine's plant and a controller in turn, as a live session does."""
    controller = Controller(TUNED, H, loop.limits, feed_forward)
    held, state = loop._held(reference[0])
    controller.start(reference[0], held)
    plant, chance = loop.plant, Chance(np.random.default_rng(seed))
    column = plant.axes.index("zn")
    command = np.array([sum(axis.range) / 2.0 for axis in plant.robot.axes.values()])
    command[column] = held
    positions, outputs = [], []
    for k, wanted in enumerate(reference, start=1):
        motion, state = plant.advance(state, np.array([k * H]), command[None], chance=chance)
        command[column] = controller.step(wanted, motion.reading[0, column])
        outputs.append(command[column])
        state = replace(state, inputs=plant.open_loop_inputs(command[None]))  # acts from now on
        positions.append(motion.position[0, column])
    return np.array(positions), np.array(outputs)


@pytest.mark.parametrize("led", [False, True])
def test_the_loop_is_to_the_bit_that_of_live_steps(worn_loop, led):
    own = {"feed_forward": FeedForward(lead_taps(worn_loop.robot_axis, H))} if led else {}
    traces = worn_loop.follow(TUNED, swing(), rng=np.random.default_rng(3), **own)
    positions, outputs = live(worn_loop, swing(), 3, **own)
    # The time of a live step is added up, that of the loop is counted.
    np.testing.assert_allclose(traces.position, positions, rtol=0, atol=1e-17)
    np.testing.assert_allclose(traces.output, outputs, rtol=0, atol=1e-16)


def test_the_controller_answers_the_loops_readings_to_the_bit(worn_loop):
    reference = swing()
    traces = worn_loop.follow(TUNED, reference, rng=np.random.default_rng(3))
    controller = Controller(TUNED, H, worn_loop.limits)
    controller.start(reference[0], worn_loop._held(reference[0])[0])
    answers = [controller.step(*pair) for pair in zip(reference, traces.reading, strict=True)]
    assert np.array(answers).tobytes() == traces.output.tobytes()


def test_at_rest_it_stays_at_rest(worn_loop):
    traces = worn_loop.follow(TUNED, np.full(500, 20e-6))
    np.testing.assert_allclose(traces.position, 20e-6, rtol=0, atol=1e-15)


def test_an_output_is_late_by_the_delay(robot):
    reference = np.r_[np.full(10, 30e-6), np.full(50, 31e-6)]
    open_loop = [
        AxisLoop(robot, "zn", RATE_HZ, delay=delay).follow(Gains(), reference).position
        for delay in (0, 3)
    ]
    np.testing.assert_allclose(open_loop[1][3:], open_loop[0][:-3], rtol=0, atol=1e-15)
    assert open_loop[0][11] > 30.1e-6 > open_loop[1][13]


def test_a_delay_of_an_effect_counts_in_the_loop_and_must_be_whole(robot):
    def late(delay_s):
        effect = AxisEffect(axis="zn", id="delay", parameters={"delay": delay_s})
        return AxisLoop(replace(robot, effects=(effect,)), "zn", RATE_HZ)

    assert late(6e-4).sampled.delay == 3
    reference = np.r_[np.full(10, 30e-6), np.full(50, 31e-6)]
    plain = AxisLoop(robot, "zn", RATE_HZ, delay=3).follow(Gains(), reference)
    np.testing.assert_allclose(
        late(6e-4).follow(Gains(), reference).position, plain.position, rtol=0, atol=1e-15
    )
    with pytest.raises(FeedbackError, match=r"1\.5 intervals .* whole number"):
        late(3e-4)


def test_a_static_axis_is_read_before_its_command_acts():
    loop = AxisLoop(load_robot("picma"), "p", 1000.0)
    reference = np.r_[np.full(3, 20e-6), np.full(60, 25e-6)]
    position = loop.follow(Gains(integral=300.0), reference).position
    # e_{k+1} = 0.7 e_k without feed-forward's help; with it the first answer is whole.
    np.testing.assert_allclose(position[:4], 20e-6, atol=1e-15)
    assert position[4] == pytest.approx(25e-6 + 0.3 * 5e-6)


def test_the_lead_lets_a_ramp_be_followed_without_lag(loop, robot):
    ramp = 10e-6 + np.maximum(np.arange(400) * H - 0.01, 0.0) * 0.4e-3
    for delay in (0, 2):
        late = AxisLoop(robot, "zn", RATE_HZ, delay=delay)
        taps = lead_taps(loop.robot_axis, H, delay=delay)
        error = late.follow(Gains(), ramp, feed_forward=FeedForward(taps)).position - ramp
        assert np.abs(error[70:]).max() < 2e-9  # 200 nm lag without
    plain = loop.follow(Gains(), ramp).position - ramp
    assert np.abs(plain[70:]).max() > 60e-9


def test_limits_hold_and_are_counted(loop):
    reference = np.r_[np.full(10, 60e-6), np.full(100, 80e-6)]
    traces = loop.follow(TUNED, reference)
    assert traces.limited >= 90
    assert traces.output.max() == loop.limits.high
    assert loop.limits.high == pytest.approx(65e-6)


def test_noise_comes_from_the_seed_alone(worn_loop):
    one, same, other = (
        worn_loop.follow(TUNED, swing(), rng=np.random.default_rng(seed)).reading
        for seed in (1, 1, 2)
    )
    assert one.tobytes() == same.tobytes() != other.tobytes()


@pytest.mark.parametrize(
    ("axis", "rate_hz", "delay", "message"),
    [
        ("q", RATE_HZ, 0, "has no such axis; use one of x, y"),
        ("zn", 0.0, 0, "loop rate 0"),
        ("zn", float("inf"), 0, "loop rate inf"),
        ("zn", RATE_HZ, -1, "0 to 1000"),
    ],
)
def test_what_cannot_be_a_loop_is_refused(robot, axis, rate_hz, delay, message):
    with pytest.raises(FeedbackError, match=message):
        AxisLoop(robot, axis, rate_hz, delay=delay)


def test_an_axis_that_a_force_moves_is_refused():
    with pytest.raises(FeedbackError, match="cascade"):
        AxisLoop(load_robot("emps"), "q", 1000.0)


def test_a_wrong_effect_is_refused(robot):
    wrong = replace(robot, effects=(AxisEffect(axis="zn", id="nothing"),))
    with pytest.raises(EffectError, match="nothing"):
        AxisLoop(wrong, "zn", RATE_HZ)
