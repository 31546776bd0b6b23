"""Poles of sampled loops against the simulated loop and closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from rotemina.sim.modes.loop import LoopError, loop_poles
from rotemina.sim.plant.plant import Plant
from rotemina.sim.robot.file import load_robot

EMPS = load_robot("emps")


def with_loop(force_offset=0.0, **changes):
    axis = EMPS.axes["q"]
    controller = replace(axis.controller, limit=10.0, **changes)
    return replace(
        EMPS, axes={"q": replace(axis, controller=controller, force_offset=force_offset)}
    )


def free_response(robot, rate_hz, count=60):
    """Positions (count,) after a small displacement, under the loop with its command at zero."""
    plant = Plant.of(robot, closed_loop=True)
    start = plant.at(0.0, np.zeros(1), np.array([1e-6]), np.zeros(1))
    motion, _ = plant.advance(start, np.arange(count) / rate_hz, np.zeros((count, 1)))
    return motion.position[:, 0]


@pytest.mark.parametrize("velocity", ["state", "backward"])
@pytest.mark.parametrize("delay_s", [0.0, 3e-4, 1e-3, 2.4e-3])
def test_the_simulated_loop_decays_by_these_poles(velocity, delay_s):
    """A response made of p^k obeys the recursion of the characteristic polynomial."""
    robot = with_loop(velocity=velocity, delay_s=delay_s, kp=60.0)
    (loop,) = loop_poles(robot, 1000.0)
    response = free_response(robot, 1000.0)
    order = len(loop.poles)
    recursion = np.convolve(response, np.poly(loop.poles).real, mode="valid")
    # The first samples know no past: the recursion holds once the memory is filled.
    assert np.abs(recursion[order:]).max() < 1e-12 * np.abs(response).max()
    wrong = np.convolve(response, np.poly(loop.poles * 0.999).real, mode="valid")
    assert np.abs(wrong[order:]).max() > 1e-7 * np.abs(response).max()


def test_one_damped_mass_by_hand():
    """Φ and Γ of m q̈ + d q̇ = g u in closed form, with u = −kv (kp q + q̇)."""
    robot, step_s = with_loop(velocity="state"), 1e-3
    axis, loop = robot.axes["q"], robot.axes["q"].controller
    lag = axis.mass / axis.damping
    decay = np.exp(-step_s / lag)
    state = np.array([[1.0, lag * (1 - decay)], [0.0, decay]])
    gain = axis.gain / axis.damping
    drive = gain * np.array([step_s - lag * (1 - decay), 1 - decay])
    closed = state - np.outer(drive, loop.kv * np.array([loop.kp, 1.0]))
    found = loop_poles(robot, 1000.0)[0].poles
    largest = found[np.argsort(np.abs(found))[-2:]]
    np.testing.assert_allclose(np.poly(largest).real, np.poly(closed), rtol=1e-9)


def test_a_loop_goes_unstable_in_the_poles_when_it_does_in_the_simulation():
    for kp, stable in ((160.0, True), (4000.0, False)):
        robot = with_loop(kp=kp)
        (loop,) = loop_poles(robot, 1000.0)
        assert loop.stable is stable
        response = np.abs(free_response(robot, 1000.0, 30))
        assert bool(response[-5:].max() < response[:5].max()) is stable
    assert "unstable at 1000 Hz" in loop.message


def test_the_shipped_loop_is_stable_at_its_rate():
    (loop,) = loop_poles(EMPS, 1000.0)
    assert loop.stable
    assert loop.message.startswith("q: loop stable at 1000 Hz; the largest pole 0.95")


@pytest.mark.parametrize("rate_hz", [0.0, -1.0, np.nan, np.inf])
def test_a_rate_that_is_none_is_refused(rate_hz):
    with pytest.raises(LoopError, match="sample rate"):
        loop_poles(EMPS, rate_hz)


def test_a_robot_without_controllers_is_refused():
    with pytest.raises(LoopError, match="no axis has a controller"):
        loop_poles(load_robot("rotemina"), 1000.0)
