"""Checks of captures and profiles, which a device executes at its own rate."""

import numpy as np

from rotemina.drivers.abilities import Capturer, ProfileRunner
from rotemina.drivers.capture import Captured
from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import Motion, Subject, interval_of
from rotemina.drivers.conformance.findings import Unmet, at_most, demand, refused, within
from rotemina.drivers.conformance.moves import STOP_LATE_S, demand_halt
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.profile import Profile, ProfileSegment
from rotemina.drivers.samples import DeviceState, Samples
from rotemina.sim.arrays import FloatArray

_CAPTURE_S = 0.2
# Of an interval: what a device may sample earlier or later than its rate has it.
_JITTER = 0.5
_EFFORT = 0.5


@check(needs=Capturer, moves=False)
def capture(bench: Bench) -> None:
    """A capture brings as many samples as asked, in order, at the rate asked, without a gap."""
    with bench.opened(to_move=False) as subject:
        driver, axis = subject.driver, subject.slow
        assert isinstance(driver, Capturer), "a check runs where its ability is"
        rates = driver.capture_rates
        count = max(2, min(rates.samples, round(_CAPTURE_S * rates.one_hz)))
        driver.capture([axis.name], rates.one_hz, count)
        parts = _captured(subject, driver, 5.0 * count / rates.one_hz + 1.0)
        time_s = np.concatenate([part.device_time_s for part in parts])
        lost = parts[-1].lost
        demand(
            len(time_s) + lost == count,
            f"{len(time_s)} samples came and {lost} were said to be lost",
            f"{count} in all",
        )
        intervals = np.diff(time_s) * rates.one_hz
        demand(bool((intervals > 0).all()), "captured samples are out of order", "later ones")
        least, most = float(intervals.min()), float(intervals.max())
        demand(
            least >= 1.0 - _JITTER and (lost > 0 or most <= 1.0 + _JITTER),
            f"captured samples are {least:.3g} to {most:.3g} intervals apart",
            f"1 ± {_JITTER:g}",
        )
        for part in parts:
            demand(part.axes == (axis.name,), f"it captured {part.axes}", f"axis {axis.name}")
            shape = (len(part.device_time_s), 1)
            demand(part.measured.shape == shape, f"readings {part.measured.shape}", f"{shape}")


def _captured(subject: Subject, driver: Capturer, limit_s: float) -> list[Captured]:
    """Let time pass until a capture is complete; return its parts."""
    parts: list[Captured] = []
    for _ in range(round(limit_s / subject.step_s)):
        subject.run(subject.step_s)
        part = driver.captured()
        if part is not None:
            parts.append(part)
            if part.complete:
                return parts
    came = sum(len(part.device_time_s) for part in parts)
    raise Unmet(f"after {limit_s:.3g} s {came} samples have come; expected: a complete capture")


@check(needs=Capturer, moves=False)
def refused_captures(bench: Bench) -> None:
    """A capture faster than the device can, of no axis, or of no samples is refused."""
    with bench.opened(to_move=False) as subject:
        driver, axis = subject.driver, subject.slow
        assert isinstance(driver, Capturer), "a check runs where its ability is"
        rate_hz = driver.capture_rates.one_hz
        refused(
            "too fast a capture", lambda: driver.capture([axis.name], 1.1 * rate_hz, 1), LimitError
        )
        refused("a capture of no axis", lambda: driver.capture(["elbow"], rate_hz, 1), LimitError)
        refused("an empty capture", lambda: driver.capture([axis.name], rate_hz, 0), LimitError)


def _runner(subject: Subject) -> ProfileRunner:
    assert isinstance(subject.driver, ProfileRunner), "a check runs where its ability is"
    return subject.driver


def _there_and_back(axis: Motion, start: float) -> Profile:
    """Return ``s (3τ² − 2τ³)`` there and back, 0.6 s each, at half of what the axis may."""
    each_s = 0.6
    # Its greatest speed is 1.5 s/T, its greatest acceleration 6 s/T².
    size = min(
        0.1 * axis.span,
        _EFFORT * axis.speed * each_s / 1.5,
        _EFFORT * axis.acceleration * each_s**2 / 6.0,
    )
    way = float(np.copysign(size, axis.stroke(start)))
    return Profile(
        axis.name,
        (
            ProfileSegment(each_s, 0.0, 3.0 * way, -2.0 * way),
            ProfileSegment(each_s, 0.0, -3.0 * way, 2.0 * way),
        ),
    )


def _polynomial(profile: Profile, start: float, time_s: FloatArray) -> FloatArray:
    """Return where a profile is at times (n,) since its beginning, m or rad."""
    command = np.full(len(time_s), start)
    begun_s, at = 0.0, start
    for one in profile.segments:
        inside = time_s > begun_s
        tau = np.clip((time_s[inside] - begun_s) / one.duration_s, 0.0, 1.0)
        command[inside] = at + one.c1 * tau + one.c2 * tau**2 + one.c3 * tau**3
        begun_s, at = begun_s + one.duration_s, at + one.length
    return command


@check(needs=ProfileRunner)
def profile_follows(bench: Bench) -> None:
    """A profile waits for its trigger, follows its polynomial, and ends where that ends."""
    with bench.opened() as subject:
        runner, axis = _runner(subject), subject.slow
        start = float(subject.command()[axis.index])
        profile = _there_and_back(axis, start)
        runner.upload(profile)
        subject.holds(0.1)
        runner.trigger()
        begun = subject.run(subject.step_s)
        demand(subject.state is not DeviceState.IDLE, "triggered it is idle", "it runs")
        samples = Samples.joined([begun, subject.rest()], len(subject.axes))
        off = _off(profile, axis, start, samples)
        # The device's own tick is not known: it is no longer than the time between its samples.
        tolerance = axis.half_step + 0.5 * interval_of(samples) * _EFFORT * axis.speed
        at_most(f"axis {axis.name} is off the profile by", off, tolerance, axis.unit)
        end = float(samples.command[-1, axis.index])
        within("the profile ends at", end, start, axis.half_step, axis.unit)


def _off(profile: Profile, axis: Motion, start: float, samples: Samples) -> float:
    """Return how far the commands are from the profile, from whenever it may have begun."""
    time_s, command = samples.device_time_s, samples.command[:, axis.index]
    interval_s = interval_of(samples)

    def worst(begun_s: float) -> float:
        expected = _polynomial(profile, start, time_s - begun_s)
        return float(np.abs(command - expected).max())

    # The trigger was said just before the first sample, and needs no longer than this.
    coarse = np.arange(-0.02, 0.15, max(interval_s, 1e-3)) + time_s[0]
    near_s = min(coarse.tolist(), key=worst)
    fine = np.linspace(-1.0, 1.0, 41) * interval_s + near_s
    return min(worst(at_s) for at_s in fine.tolist())


@check(needs=ProfileRunner)
def refused_profiles(bench: Bench) -> None:
    """A profile that leaves the range or is too fast is refused, and none runs without one."""
    with bench.opened() as subject:
        runner, axis = _runner(subject), subject.slow
        beyond = Profile(axis.name, (ProfileSegment(100.0, 2.0 * axis.span, 0.0, 0.0),))
        refused("a profile beyond the range", lambda: runner.upload(beyond), LimitError)
        if runner.robot.axes[axis.name].max_speed is not None:
            at = float(subject.command()[axis.index])
            way = float(np.copysign(0.01 * 1.5 * axis.speed, axis.stroke(at)))
            hasty = Profile(axis.name, (ProfileSegment(0.01, way, 0.0, 0.0),))
            refused("too fast a profile", lambda: runner.upload(hasty), LimitError)
        refused("a trigger without a profile", runner.trigger, StateError)
        subject.holds()


@check(needs=ProfileRunner)
def profile_aborted(bench: Bench) -> None:
    """An aborted profile halts within the stopping distance, without a fault, and is forgotten."""
    with bench.opened() as subject:
        runner, axis = _runner(subject), subject.slow
        profile = _there_and_back(axis, float(subject.command()[axis.index]))
        runner.upload(profile)
        runner.trigger()
        before = subject.run(0.3)
        runner.abort()
        after = subject.rest()
        demand_halt(subject, axis, before, after, late_s=STOP_LATE_S)
        subject.holds()
        refused("a trigger after an abort", runner.trigger, StateError)
