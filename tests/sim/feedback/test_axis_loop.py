"""The simulated loop equals the plant with the live controller, sample by sample."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.errors import EffectError, FeedbackError
from rotemina.sim.feedback import (
    AxisLoop,
    ControllerGains,
    FeedForward,
    NotchFilter,
    SampledController,
    compute_lead_taps,
)
from rotemina.sim.plant import RandomStreams
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot

RATE_HZ, SAMPLE_S = 5000.0, 2e-4
TUNED = ControllerGains(proportional=0.05, integral=800.0, notch=NotchFilter(420.0, 1.0, 0.025))


def make_reference(rows=300):
    return 30e-6 + 10e-6 * np.sin(2 * np.pi * 20.0 * SAMPLE_S * np.arange(rows))


def run_live(loop, reference, seed, feed_forward=None):
    """Advance the plant and the controller in turn, as a live session does."""
    controller = SampledController(TUNED, SAMPLE_S, loop.limits, feed_forward)
    rest_command, state = loop._find_rest(reference[0])
    controller.start(reference[0], rest_command)
    plant, streams = loop.plant, RandomStreams(np.random.default_rng(seed))
    column = plant.axes.index("zn")
    command = np.array([sum(axis.range) / 2.0 for axis in plant.robot.axes.values()])
    command[column] = rest_command
    positions, outputs = [], []
    for k, desired in enumerate(reference, start=1):
        motion, state = plant.advance(
            state, np.array([k * SAMPLE_S]), command[None], random_streams=streams
        )
        command[column] = controller.step(desired, motion.reading[0, column])
        outputs.append(command[column])
        state = replace(
            state, inputs=plant.compute_open_loop_inputs(command[None])
        )  # acts from the next step on
        positions.append(motion.position[0, column])
    return np.array(positions), np.array(outputs)


@pytest.mark.parametrize("has_lead", [False, True])
def test_the_loop_equals_live_steps(worn_loop, has_lead):
    options = (
        {"feed_forward": FeedForward(compute_lead_taps(worn_loop.robot_axis, SAMPLE_S))}
        if has_lead
        else {}
    )
    traces = worn_loop.follow(TUNED, make_reference(), rng=np.random.default_rng(3), **options)
    positions, outputs = run_live(worn_loop, make_reference(), 3, **options)
    # Live steps add up the time, the loop counts rows, so the results differ by rounding.
    np.testing.assert_allclose(traces.position, positions, rtol=0, atol=1e-17)
    np.testing.assert_allclose(traces.output, outputs, rtol=0, atol=1e-16)


def test_the_controller_gives_the_outputs_of_the_loop_bit_for_bit(worn_loop):
    reference = make_reference()
    traces = worn_loop.follow(TUNED, reference, rng=np.random.default_rng(3))
    controller = SampledController(TUNED, SAMPLE_S, worn_loop.limits)
    controller.start(reference[0], worn_loop._find_rest(reference[0])[0])
    outputs = [controller.step(*pair) for pair in zip(reference, traces.reading, strict=True)]
    assert np.array(outputs).tobytes() == traces.output.tobytes()


def test_a_loop_at_rest_stays_at_rest(worn_loop):
    traces = worn_loop.follow(TUNED, np.full(500, 20e-6))
    np.testing.assert_allclose(traces.position, 20e-6, rtol=0, atol=1e-15)


def test_the_response_lags_by_the_delay_even_of_an_effect_of_whole_intervals(robot):
    def make_delayed_loop(delay_s):
        effect = AxisEffect(axis="zn", id="delay", parameters={"delay": delay_s})
        return AxisLoop(replace(robot, effects=(effect,)), "zn", RATE_HZ)

    assert make_delayed_loop(6e-4).sampled_axis.delay == 3
    reference = np.r_[np.full(10, 30e-6), np.full(50, 31e-6)]
    undelayed, delayed, with_effect = (
        loop.follow(ControllerGains(), reference).position
        for loop in (
            AxisLoop(robot, "zn", RATE_HZ),
            AxisLoop(robot, "zn", RATE_HZ, delay=3),
            make_delayed_loop(6e-4),
        )
    )
    np.testing.assert_allclose(delayed[3:], undelayed[:-3], rtol=0, atol=1e-15)
    np.testing.assert_allclose(with_effect, delayed, rtol=0, atol=1e-15)
    assert undelayed[11] > 30.1e-6 > delayed[13]
    with pytest.raises(FeedbackError, match=r"1\.5 intervals .* whole number"):
        make_delayed_loop(3e-4)


def test_a_static_axis_is_read_before_its_command_acts():
    loop = AxisLoop(load_robot("picma"), "p", 1000.0)
    reference = np.r_[np.full(3, 20e-6), np.full(60, 25e-6)]
    position = loop.follow(ControllerGains(integral=300.0), reference).position
    # The feed-forward alone reaches the target, and the integral adds 0.3 of the first error.
    np.testing.assert_allclose(position[:4], 20e-6, atol=1e-15)
    assert position[4] == pytest.approx(25e-6 + 0.3 * 5e-6)


def test_with_lead_a_ramp_is_followed_without_lag(loop, robot):
    ramp = 10e-6 + np.maximum(np.arange(400) * SAMPLE_S - 0.01, 0.0) * 0.4e-3
    for delay in (0, 2):
        delayed_loop = AxisLoop(robot, "zn", RATE_HZ, delay=delay)
        taps = compute_lead_taps(loop.robot_axis, SAMPLE_S, delay=delay)
        error = (
            delayed_loop.follow(ControllerGains(), ramp, feed_forward=FeedForward(taps)).position
            - ramp
        )
        assert np.abs(error[70:]).max() < 2e-9  # the lag is 200 nm without lead
    error_without_lead = loop.follow(ControllerGains(), ramp).position - ramp
    assert np.abs(error_without_lead[70:]).max() > 60e-9


def test_outputs_stay_within_limits_and_limited_rows_are_counted(loop):
    reference = np.r_[np.full(10, 60e-6), np.full(100, 80e-6)]
    traces = loop.follow(TUNED, reference)
    assert traces.limited_count >= 90
    assert traces.output.max() == loop.limits.high
    assert loop.limits.high == pytest.approx(65e-6)


def test_noise_depends_only_on_the_seed(worn_loop):
    first, repeated, other = (
        worn_loop.follow(TUNED, make_reference(), rng=np.random.default_rng(seed)).reading
        for seed in (1, 1, 2)
    )
    assert first.tobytes() == repeated.tobytes() != other.tobytes()


@pytest.mark.parametrize(
    ("robot", "axis", "rate_hz", "delay", "message"),
    [
        ("rotemina", "q", RATE_HZ, 0, "has no such axis; use one of x, y"),
        ("rotemina", "zn", 0.0, 0, "loop rate 0"),
        ("rotemina", "zn", float("inf"), 0, "loop rate inf"),
        ("rotemina", "zn", RATE_HZ, -1, "0 to 1000"),
        ("emps", "q", 1000.0, 0, "cascade"),
    ],
)
def test_invalid_loops_are_refused(robot, axis, rate_hz, delay, message):
    with pytest.raises(FeedbackError, match=message):
        AxisLoop(load_robot(robot), axis, rate_hz, delay=delay)


def test_a_wrong_effect_is_refused(robot):
    faulty_robot = replace(robot, effects=(AxisEffect(axis="zn", id="nothing"),))
    with pytest.raises(EffectError, match="nothing"):
        AxisLoop(faulty_robot, "zn", RATE_HZ)
