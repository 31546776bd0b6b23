"""Scaling laws: bounds for any input, exact motion, and changes in mid-move without a jump."""

from math import copysign, exp, inf, nan, sqrt

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from rotemina.app.motion.teleoperation.force_feedback import Contact
from rotemina.app.motion.teleoperation.impedance import Impedance
from rotemina.app.motion.teleoperation.linear_laws import LinearPosition, LinearRate
from rotemina.app.motion.teleoperation.reference import (
    APPROACH_S,
    Bounds,
    Motion,
    ScalingError,
)
from rotemina.app.motion.teleoperation.scaling import STEP_PRESETS, next_preset
from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance

DT = 0.005
TABLE = Bounds(0.0, 0.08, 0.01, 0.2)
LAWS = {
    "position": lambda bounds: LinearPosition(bounds, 0.3 * (bounds.high - bounds.low)),
    "rate": lambda bounds: LinearRate(bounds, 2.0 * bounds.max_speed),
    "gliding": lambda bounds: Impedance(
        bounds,
        VirtualImpedance.gliding(
            bounds.max_speed, 3.0 * bounds.max_speed / bounds.max_acceleration
        ),
        Contact(0.0, 0.0, 0.1),
    ),
    "sprung": lambda bounds: Impedance(
        bounds, VirtualImpedance.sprung(bounds.max_acceleration / 400.0, 1.5, 0.3)
    ),
}

bounds_strategy = st.builds(
    lambda low, span, speed, ramp: Bounds(low, low + span, speed * span, speed * span / ramp),
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
    """A motion within the acceleration leads from one to the other, and can stop in the range."""
    most, span = bounds.max_acceleration, bounds.high - bounds.low
    atom = 1e-9 * (span + abs(bounds.low))
    assert bounds.low <= after.position <= bounds.high
    assert abs(after.velocity) <= bounds.max_speed * (1.0 + 1e-12)
    change = after.velocity - before.velocity
    assert abs(change) <= most * dt * (1.0 + 1e-9) + 1e-9 * bounds.max_speed
    middle = before.position + 0.5 * (before.velocity + after.velocity) * dt
    room = max((most * dt) ** 2 - change**2, 0.0) / (4.0 * most)
    assert abs(after.position - middle) <= room + atom
    assert bounds.low - atom <= bounds.stopping_place(after) <= bounds.high + atom


@settings(max_examples=300, deadline=None)
@given(
    bounds_strategy,
    st.sampled_from(sorted(LAWS)),
    st.lists(step_strategy, max_size=40),
    st.floats(0.0, 1.0),
    st.floats(-1.0, 1.0),
)
@example(TABLE, "position", [(1.0, 0.1, "step", 0.0)] * 30, 1.0, 1.0)
def test_the_reference_keeps_to_its_bounds_whatever_comes(bounds, name, steps, place, speed):
    law = LAWS[name](bounds)
    span = bounds.high - bounds.low
    motion = law.start(bounds.low + place * span, speed * bounds.max_speed, 0.5)
    for deflection, dt, what, value in steps:
        before = motion
        if what == "start":
            motion = law.start(motion.position, motion.velocity, deflection)
        elif what == "hold":
            motion = law.hold(bounds.low + value * span, speed * bounds.max_speed)
            before = motion
        elif what == "rescale":
            law.rescale(0.1 + 10.0 * value)
        moved = law.step(deflection, dt, value - 0.5)
        assert_reachable(bounds, motion, moved, dt)
        if what in ("start", "rescale"):
            assert motion.position == pytest.approx(before.position, abs=1e-12)
            # An atom's way from an end, the speed that can still be braked is the root of one.
            slack = 1e-12 + 1e-7 * bounds.max_speed
            assert motion.velocity == pytest.approx(before.velocity, abs=slack)
        motion = moved


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
def test_bounds_that_are_none_are_refused(bad):
    with pytest.raises(ScalingError, match="must be finite"):
        Bounds(*bad)


def test_presets_go_round_in_one_two_five():
    seen = [0.1]
    while len(seen) < len(STEP_PRESETS) + 1:
        seen.append(next_preset(seen[-1]))
    assert seen == [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 0.1]


def run(law, deflection, seconds, dt=DT):
    return [law.step(deflection, dt) for _ in range(round(seconds / dt))]


# --- linear position ------------------------------------------------------------------------------


def test_a_deflected_stick_moves_nothing_at_the_start():
    law = LinearPosition(TABLE, 0.01)
    law.start(0.03, 0.0, 0.7)
    assert all(motion == (0.03, 0.0) for motion in run(law, 0.7, 0.2))


@pytest.mark.parametrize("way", [3e-7, 1e-4, -1.1e-3, 0.02])
@pytest.mark.parametrize("dt", [0.001, 0.005, 0.0137])
def test_a_stick_that_jumps_is_followed_soon_and_without_overshoot(way, dt):
    law = LinearPosition(TABLE, way)
    law.start(0.04, 0.0, 0.0)
    most, top = TABLE.max_acceleration, TABLE.max_speed
    size = abs(way)
    least = 2.0 * sqrt(size / most) if size < top**2 / most else size / top + top / most
    motions = run(law, 1.0, least + 20.0 * APPROACH_S, dt)
    left = [size - copysign(1.0, way) * (motion.position - 0.04) for motion in motions]
    assert min(left) >= -1e-15
    for number, gap in enumerate(left):
        late_s = (number - 1) * dt - least
        assert gap <= size * min(exp(-late_s / APPROACH_S), 1.0) + 1e-15
        # A speed that acts for T longer than meant does not lead beyond.
        assert abs(motions[number].velocity) * APPROACH_S <= gap + 1e-15
    assert motions[-1].velocity == pytest.approx(0.0, abs=1e-8 * top)


def test_the_clutch_indexes_anew():
    law = LinearPosition(TABLE, 1e-3)
    law.start(0.04, 0.0, 0.0)
    run(law, 1.0, 1.0)
    law.start(*law.motion, -1.0)  # brought back with the clutch held
    run(law, 0.0, 1.0)
    assert law.motion.position == pytest.approx(0.042)


def test_a_law_started_in_mid_move_does_not_turn_back():
    law = LinearPosition(TABLE, 1e-3)
    law.start(0.04, 8e-3, 0.3)
    places = [motion.position for motion in run(law, 0.3, 0.1)]
    assert places == sorted(places)
    assert law.motion == Motion(pytest.approx(0.04 + 8e-3**2 / 0.4), 0.0)


def test_a_change_of_scale_leaves_the_target():
    law = LinearPosition(TABLE, 1e-3)
    law.start(0.04, 0.0, 0.0)
    run(law, 0.8, 1.0)
    law.rescale(0.1)
    assert run(law, 0.8, 0.1)[-1].position == pytest.approx(0.0408, abs=1e-11)
    assert run(law, 0.3, 1.0)[-1].position == pytest.approx(0.0408 - 0.5e-4)


def test_at_the_end_of_the_range_the_stick_comes_back_by_its_own_way():
    law = LinearPosition(TABLE, 1e-3)
    law.start(0.0795, 0.0, 0.0)
    assert run(law, 1.0, 1.0)[-1].position == pytest.approx(0.08, abs=1e-11)
    assert run(law, 0.2, 1.0)[-1].position == pytest.approx(0.0797)


# --- linear rate ----------------------------------------------------------------------------------


def test_the_rate_ramps_and_holds():
    law = LinearRate(TABLE, 5e-3)
    law.start(0.04, 0.0, 0.0)
    speeds = [motion.velocity for motion in run(law, 0.8, 0.1)]
    assert speeds[:4] == pytest.approx([1e-3, 2e-3, 3e-3, 4e-3])
    assert speeds[4:] == pytest.approx([4e-3] * 16)
    assert law.motion.position == pytest.approx(0.04 + 4e-3 * (0.1 - 0.5 * 0.02))


def test_the_rate_ends_at_the_range_s_end_and_does_not_wind_up():
    law = LinearRate(TABLE, 0.01)
    law.start(0.079, 0.0, 0.0)
    assert run(law, 1.0, 10.0)[-1] == Motion(pytest.approx(0.08, abs=1e-12), pytest.approx(0.0))
    assert law.step(-1.0, DT).position < 0.08


def test_hold_keeps_the_reference_at_the_machine():
    law = LinearRate(TABLE, 2e-3)
    law.start(0.04, 0.0, 0.0)
    for _ in range(200):
        law.step(1.0, DT)
        law.hold(0.04, 1e-3)
    assert law.motion == (0.04, 1e-3)
    assert law.step(1.0, DT).position <= 0.04 + 1e-5


@pytest.mark.parametrize("make", [LinearRate, LinearPosition])
@pytest.mark.parametrize("scale", [0.0, nan, inf])
def test_a_scale_that_is_none_is_refused(make, scale):
    with pytest.raises(ScalingError, match="scale"):
        make(TABLE, scale)


# --- from one law to another ----------------------------------------------------------------------


@pytest.mark.parametrize("first", sorted(LAWS))
@pytest.mark.parametrize("second", sorted(LAWS))
def test_switching_in_mid_move_has_no_jump(first, second):
    one, other = LAWS[first](TABLE), LAWS[second](TABLE)
    one.start(0.03, 0.0, 0.0)
    run(one, 0.9, 0.2)
    before = one.motion
    after = other.start(*before, 0.9)
    assert after == before
    assert_reachable(TABLE, after, other.step(0.9, DT), DT)
