"""Scaling laws: bounds for any input, exact motion, and changes during a move without a jump."""

from math import copysign, exp, inf, nan, sqrt

import pytest
from hypothesis import example, given, settings, strategies as st

from rotemina.app.errors import ScalingError
from rotemina.app.motion.teleoperation import (
    STEP_PRESETS,
    ImpedanceLaw,
    LinearPositionLaw,
    LinearRateLaw,
)
from rotemina.app.motion.teleoperation.force_feedback import ContactFeedback
from rotemina.app.motion.teleoperation.reference import (
    APPROACH_TIME_CONSTANT_S,
    CoordinateBounds,
    ReferenceMotion,
)
from rotemina.app.motion.teleoperation.scaling import find_next_preset
from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance

DT = 0.005
TABLE = CoordinateBounds(0.0, 0.08, 0.01, 0.2)
LAWS = {
    "position": lambda bounds: LinearPositionLaw(bounds, 0.3 * (bounds.high - bounds.low)),
    "rate": lambda bounds: LinearRateLaw(bounds, 2.0 * bounds.max_speed),
    "gliding": lambda bounds: ImpedanceLaw(
        bounds,
        VirtualImpedance.make_gliding(
            bounds.max_speed, 3.0 * bounds.max_speed / bounds.max_acceleration
        ),
        ContactFeedback(0.0, 0.0, 0.1),
    ),
    "sprung": lambda bounds: ImpedanceLaw(
        bounds, VirtualImpedance.make_sprung(bounds.max_acceleration / 400.0, 1.5, 0.3)
    ),
}

bounds_strategy = st.builds(
    lambda low, span, speed, ramp: CoordinateBounds(
        low, low + span, speed * span, speed * span / ramp
    ),
    st.floats(-1.0, 1.0),
    st.floats(1e-5, 1.0),
    st.floats(1e-3, 1e3),
    st.floats(1e-3, 10.0),
)
step_strategy = st.tuples(
    st.one_of(st.floats(-1.0, 1.0), st.sampled_from([-1.0, 0.0, 1.0])),
    st.floats(0.0, 0.1),
    st.sampled_from(["step", "step", "step", "start", "hold", "rescale"]),
    st.floats(0.0, 1.0),
)


def assert_reachable(bounds, before, after, dt):
    """Assert that a motion within the acceleration connects both, and can stop in the range."""
    max_acceleration, span = bounds.max_acceleration, bounds.high - bounds.low
    atom = 1e-9 * (span + abs(bounds.low))
    assert bounds.low <= after.position <= bounds.high
    assert abs(after.velocity) <= bounds.max_speed * (1.0 + 1e-12)
    change = after.velocity - before.velocity
    assert abs(change) <= max_acceleration * dt * (1.0 + 1e-9) + 1e-9 * bounds.max_speed
    middle = before.position + 0.5 * (before.velocity + after.velocity) * dt
    reach = max((max_acceleration * dt) ** 2 - change**2, 0.0) / (4.0 * max_acceleration)
    assert abs(after.position - middle) <= reach + atom
    assert bounds.low - atom <= bounds.find_stopping_position(after) <= bounds.high + atom


@settings(max_examples=300, deadline=None)
@given(
    bounds_strategy,
    st.sampled_from(sorted(LAWS)),
    st.lists(step_strategy, max_size=40),
    st.floats(0.0, 1.0),
    st.floats(-1.0, 1.0),
)
@example(TABLE, "position", [(1.0, 0.1, "step", 0.0)] * 30, 1.0, 1.0)
def test_the_reference_keeps_to_its_bounds_for_any_input(bounds, name, steps, place, speed):
    law = LAWS[name](bounds)
    span = bounds.high - bounds.low
    motion = law.start(bounds.low + place * span, speed * bounds.max_speed, 0.5)
    for deflection, dt, action, value in steps:
        before = motion
        if action == "start":
            motion = law.start(motion.position, motion.velocity, deflection)
        elif action == "hold":
            motion = law.hold_at(bounds.low + value * span, speed * bounds.max_speed)
            before = motion
        elif action == "rescale":
            law.rescale(0.1 + 10.0 * value)
        next_motion = law.step(deflection, dt, value - 0.5)
        assert_reachable(bounds, motion, next_motion, dt)
        if action in ("start", "rescale"):
            assert motion.position == pytest.approx(before.position, abs=1e-12)
            # At one atom from an end, the speed that can still be braked scales with its root.
            slack = 1e-12 + 1e-7 * bounds.max_speed
            assert motion.velocity == pytest.approx(before.velocity, abs=slack)
        motion = next_motion


@pytest.mark.parametrize("name", sorted(LAWS))
def test_bad_numbers_are_refused(name):
    law = LAWS[name](TABLE)
    for bad in ((nan, DT), (inf, DT), (0.0, nan), (0.0, -DT), (0.0, DT, inf)):
        with pytest.raises(ScalingError, match="finite"):
            law.step(*bad)
    for factor in (0.0, -1.0, nan):
        with pytest.raises(ScalingError, match="factor"):
            law.rescale(factor)


@pytest.mark.parametrize("bad", [(0, 1, 0, 1), (0, 1, 1, -1), (1, 0, 1, 1), (0, inf, 1, 1)])
def test_invalid_bounds_are_refused(bad):
    with pytest.raises(ScalingError, match="must be finite"):
        CoordinateBounds(*bad)


def test_presets_cycle_in_steps_of_one_two_five():
    presets = [0.1]
    while len(presets) < len(STEP_PRESETS) + 1:
        presets.append(find_next_preset(presets[-1]))
    assert presets == [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 0.1]


def run(law, deflection, seconds, dt=DT):
    return [law.step(deflection, dt) for _ in range(round(seconds / dt))]


# Linear position


@pytest.mark.parametrize("travel", [3e-7, -1.1e-3, 0.02])
@pytest.mark.parametrize("dt", [0.001, 0.0137])
def test_a_jump_of_the_stick_is_followed_without_overshoot(travel, dt):
    law = LinearPositionLaw(TABLE, travel)
    law.start(0.04, 0.0, 0.0)
    max_acceleration, max_speed = TABLE.max_acceleration, TABLE.max_speed
    size = abs(travel)
    min_time_s = (
        2.0 * sqrt(size / max_acceleration)
        if size < max_speed**2 / max_acceleration
        else size / max_speed + max_speed / max_acceleration
    )
    motions = run(law, 1.0, min_time_s + 20.0 * APPROACH_TIME_CONSTANT_S, dt)
    gaps = [size - copysign(1.0, travel) * (motion.position - 0.04) for motion in motions]
    assert min(gaps) >= -1e-15
    for number, gap in enumerate(gaps):
        late_s = (number - 1) * dt - min_time_s
        assert gap <= size * min(exp(-late_s / APPROACH_TIME_CONSTANT_S), 1.0) + 1e-15
        # A speed that acts for one time constant too long does not overshoot.
        assert abs(motions[number].velocity) * APPROACH_TIME_CONSTANT_S <= gap + 1e-15
    assert motions[-1].velocity == pytest.approx(0.0, abs=1e-8 * max_speed)


def test_a_law_started_during_a_move_does_not_reverse():
    law = LinearPositionLaw(TABLE, 1e-3)
    law.start(0.04, 8e-3, 0.3)
    positions = [motion.position for motion in run(law, 0.3, 0.1)]
    assert positions == sorted(positions)
    assert law.motion == ReferenceMotion(pytest.approx(0.04 + 8e-3**2 / 0.4), 0.0)


def test_a_change_of_scale_keeps_the_target():
    law = LinearPositionLaw(TABLE, 1e-3)
    law.start(0.04, 0.0, 0.0)
    run(law, 0.8, 1.0)
    law.rescale(0.1)
    assert run(law, 0.8, 0.1)[-1].position == pytest.approx(0.0408, abs=1e-11)
    assert run(law, 0.3, 1.0)[-1].position == pytest.approx(0.0408 - 0.5e-4)


def test_beyond_the_end_of_the_range_no_travel_accumulates():
    law = LinearPositionLaw(TABLE, 1e-3)
    law.start(0.0795, 0.0, 0.0)
    assert run(law, 1.0, 1.0)[-1].position == pytest.approx(0.08, abs=1e-11)
    assert run(law, 0.2, 1.0)[-1].position == pytest.approx(0.0797)


# Linear rate


def test_the_rate_ramps_and_holds():
    law = LinearRateLaw(TABLE, 5e-3)
    law.start(0.04, 0.0, 0.0)
    speeds = [motion.velocity for motion in run(law, 0.8, 0.1)]
    assert speeds[:4] == pytest.approx([1e-3, 2e-3, 3e-3, 4e-3])
    assert speeds[4:] == pytest.approx([4e-3] * 16)
    assert law.motion.position == pytest.approx(0.04 + 4e-3 * (0.1 - 0.5 * 0.02))


def test_hold_keeps_the_reference_at_the_machine():
    law = LinearRateLaw(TABLE, 2e-3)
    law.start(0.04, 0.0, 0.0)
    for _ in range(200):
        law.step(1.0, DT)
        law.hold_at(0.04, 1e-3)
    assert law.motion == (0.04, 1e-3)
    assert law.step(1.0, DT).position <= 0.04 + 1e-5


@pytest.mark.parametrize("law_type", [LinearRateLaw, LinearPositionLaw])
@pytest.mark.parametrize("scale", [0.0, nan, inf])
def test_an_invalid_scale_is_refused(law_type, scale):
    with pytest.raises(ScalingError, match="scale"):
        law_type(TABLE, scale)


# Switching laws
