"""Checks of captures and profiles, which a device executes at its own rate."""

import numpy as np

from rotemina.drivers.abilities import (
    CapturedSamples,
    FastCapturer,
    MotionProfile,
    ProfileRunner,
    ProfileSegment,
)
from rotemina.drivers.conformance.bench import DriverBench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import (
    AxisUnderTest,
    DriverUnderTest,
    find_sample_interval,
)
from rotemina.drivers.conformance.findings import (
    RequirementNotMet,
    require_at_most,
    require_refusal,
    require_that,
    require_within,
)
from rotemina.drivers.conformance.moves import MAX_STOP_DELAY_S, require_halt
from rotemina.drivers.contract import DeviceSamples, DeviceState, LimitError, StateError
from rotemina.sim.arrays import FloatArray

_CAPTURE_DURATION_S = 0.2
# Maximum deviation of the time between two samples from the nominal interval, in intervals.
_MAX_JITTER_INTERVALS = 0.5
# The test profile uses this fraction of the axis' speed and acceleration limits.
_EFFORT_RATIO = 0.5


@check(needs=FastCapturer, moves=False)
def capture(bench: DriverBench) -> None:
    """A capture delivers the requested number of samples in order, without gaps, at its rate."""
    with bench.open_driver(to_move=False) as subject:
        driver, axis = subject.driver, subject.slowest_axis
        assert isinstance(driver, FastCapturer), "a check runs only if the driver has the ability"
        rates = driver.capture_rates
        count = max(2, min(rates.max_samples, round(_CAPTURE_DURATION_S * rates.single_axis_hz)))
        driver.capture([axis.name], rates.single_axis_hz, count)
        parts = _collect_capture(subject, driver, 5.0 * count / rates.single_axis_hz + 1.0)
        time_s = np.concatenate([part.device_time_s for part in parts])
        lost = parts[-1].lost
        require_that(
            len(time_s) + lost == count,
            f"{len(time_s)} samples arrived and {lost} were reported as lost",
            f"{count} in total",
        )
        require_that(len(time_s) >= 2, f"{len(time_s)} of {count} samples arrived", "at least 2")
        intervals = np.diff(time_s) * rates.single_axis_hz
        require_that(
            bool((intervals > 0).all()), "captured samples are out of order", "increasing times"
        )
        shortest, longest = float(intervals.min()), float(intervals.max())
        require_that(
            shortest >= 1.0 - _MAX_JITTER_INTERVALS
            and (lost > 0 or longest <= 1.0 + _MAX_JITTER_INTERVALS),
            f"captured samples are {shortest:.3g} to {longest:.3g} intervals apart",
            f"1 ± {_MAX_JITTER_INTERVALS:g}",
        )
        for part in parts:
            require_that(part.axes == (axis.name,), f"it captured {part.axes}", f"axis {axis.name}")
            shape = (len(part.device_time_s), 1)
            require_that(
                part.measured.shape == shape, f"readings {part.measured.shape}", f"{shape}"
            )


def _collect_capture(
    subject: DriverUnderTest, driver: FastCapturer, timeout_s: float
) -> list[CapturedSamples]:
    parts: list[CapturedSamples] = []
    for _ in range(round(timeout_s / subject.step_s)):
        subject.run(subject.step_s)
        part = driver.read_capture()
        if part is not None:
            parts.append(part)
            if part.complete:
                return parts
    count = sum(len(part.device_time_s) for part in parts)
    raise RequirementNotMet(
        f"after {timeout_s:.3g} s {count} samples arrived; expected: a complete capture"
    )


@check(needs=FastCapturer, moves=False)
def refused_captures(bench: DriverBench) -> None:
    """A capture is refused if it is too fast, names an unknown axis, or has no samples."""
    with bench.open_driver(to_move=False) as subject:
        driver, axis = subject.driver, subject.slowest_axis
        assert isinstance(driver, FastCapturer), "a check runs only if the driver has the ability"
        rate_hz = driver.capture_rates.single_axis_hz
        require_refusal(
            "too fast a capture", lambda: driver.capture([axis.name], 1.1 * rate_hz, 1), LimitError
        )
        require_refusal(
            "a capture of an unknown axis",
            lambda: driver.capture(["elbow"], rate_hz, 1),
            LimitError,
        )
        require_refusal(
            "an empty capture", lambda: driver.capture([axis.name], rate_hz, 0), LimitError
        )


def _get_runner(subject: DriverUnderTest) -> ProfileRunner:
    assert isinstance(subject.driver, ProfileRunner), (
        "a check runs only if the driver has the ability"
    )
    return subject.driver


def _make_round_trip(axis: AxisUnderTest, start: float) -> MotionProfile:
    """Return a profile that moves by ``s`` and back, each as ``s (3τ² − 2τ³)`` in 0.6 s.

    Its peak speed and peak acceleration are at most half the axis' limits.
    """
    stroke_duration_s = 0.6
    # The peak speed is 1.5 s/T, and the peak acceleration 6 s/T².
    size = min(
        0.1 * axis.span,
        _EFFORT_RATIO * axis.speed * stroke_duration_s / 1.5,
        _EFFORT_RATIO * axis.acceleration * stroke_duration_s**2 / 6.0,
    )
    distance = float(np.copysign(size, axis.compute_stroke(start)))
    return MotionProfile(
        axis.name,
        (
            ProfileSegment(stroke_duration_s, 0.0, 3.0 * distance, -2.0 * distance),
            ProfileSegment(stroke_duration_s, 0.0, -3.0 * distance, 2.0 * distance),
        ),
    )


def _evaluate_profile(profile: MotionProfile, start: float, time_s: FloatArray) -> FloatArray:
    """Return the positions of a profile, m or rad, at times (n,) since its start, s."""
    command = np.full(len(time_s), start)
    segment_start_s, position = 0.0, start
    for segment in profile.segments:
        inside = time_s > segment_start_s
        tau = np.clip((time_s[inside] - segment_start_s) / segment.duration_s, 0.0, 1.0)
        command[inside] = position + segment.c1 * tau + segment.c2 * tau**2 + segment.c3 * tau**3
        segment_start_s, position = (
            segment_start_s + segment.duration_s,
            position + segment.displacement,
        )
    return command


@check(needs=ProfileRunner)
def profile_follows(bench: DriverBench) -> None:
    """A profile waits for its trigger, follows its polynomials, and ends at its end position."""
    with bench.open_driver() as subject:
        runner, axis = _get_runner(subject), subject.slowest_axis
        start = float(subject.read_command()[axis.index])
        profile = _make_round_trip(axis, start)
        runner.upload(profile)
        subject.require_hold(0.1)
        runner.trigger()
        first = subject.run(subject.step_s)
        require_that(
            subject.state is not DeviceState.IDLE, "after the trigger it is idle", "it runs"
        )
        samples = DeviceSamples.join([first, subject.run_until_idle()], len(subject.axes))
        error = _find_max_profile_error(profile, axis, start, samples)
        # The device evaluates the profile at its own ticks, whose period is unknown but at most the
        # time between samples. Within half a period the axis moves by half a period times speed.
        tolerance = (
            axis.half_step + 0.5 * find_sample_interval(samples) * _EFFORT_RATIO * axis.speed
        )
        require_at_most(f"axis {axis.name} is off the profile by", error, tolerance, axis.unit)
        end = float(samples.command[-1, axis.index])
        require_within("the profile ends at", end, start, axis.half_step, axis.unit)


def _find_max_profile_error(
    profile: MotionProfile, axis: AxisUnderTest, start: float, samples: DeviceSamples
) -> float:
    """Return the maximum deviation of the commands from the profile, m or rad.

    The start time of the profile is unknown, so the start time that fits best is used.
    """
    time_s, command = samples.device_time_s, samples.command[:, axis.index]
    interval_s = find_sample_interval(samples)

    def compute_max_error(start_s: float) -> float:
        expected = _evaluate_profile(profile, start, time_s - start_s)
        return float(np.abs(command - expected).max())

    # The trigger was sent just before the first sample, and takes effect within this window.
    coarse_starts_s = np.arange(-0.02, 0.15, max(interval_s, 1e-3)) + time_s[0]
    best_coarse_s = min(coarse_starts_s.tolist(), key=compute_max_error)
    fine_starts_s = np.linspace(-1.0, 1.0, 41) * interval_s + best_coarse_s
    return min(compute_max_error(start_s) for start_s in fine_starts_s.tolist())


@check(needs=ProfileRunner)
def refused_profiles(bench: DriverBench) -> None:
    """A profile out of range or too fast is refused, and so is a trigger without a profile."""
    with bench.open_driver() as subject:
        runner, axis = _get_runner(subject), subject.slowest_axis
        beyond = MotionProfile(axis.name, (ProfileSegment(100.0, 2.0 * axis.span, 0.0, 0.0),))
        require_refusal("a profile beyond the range", lambda: runner.upload(beyond), LimitError)
        if runner.robot.axes[axis.name].max_speed is not None:
            position = float(subject.read_command()[axis.index])
            distance = float(np.copysign(0.01 * 1.5 * axis.speed, axis.compute_stroke(position)))
            too_fast = MotionProfile(axis.name, (ProfileSegment(0.01, distance, 0.0, 0.0),))
            require_refusal("too fast a profile", lambda: runner.upload(too_fast), LimitError)
        require_refusal("a trigger without a profile", runner.trigger, StateError)
        subject.require_hold()


@check(needs=ProfileRunner)
def profile_aborted(bench: DriverBench) -> None:
    """An aborted profile halts within the stopping distance, without a fault, and is discarded."""
    with bench.open_driver() as subject:
        runner, axis = _get_runner(subject), subject.slowest_axis
        profile = _make_round_trip(axis, float(subject.read_command()[axis.index]))
        runner.upload(profile)
        runner.trigger()
        before = subject.run(0.3)
        runner.abort()
        after = subject.run_until_idle()
        require_halt(subject, axis, before, after, max_delay_s=MAX_STOP_DELAY_S)
        subject.require_hold()
        require_refusal("a trigger after an abort", runner.trigger, StateError)
