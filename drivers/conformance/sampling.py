"""Checks of a driver's samples, and of concurrent calls by several threads."""

import threading
from collections.abc import Callable

import numpy as np

from rotemina.drivers.conformance.bench import DriverBench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import find_sample_interval
from rotemina.drivers.conformance.findings import CheckNotApplicable, require_that, require_within
from rotemina.drivers.contract import DeviceSamples, Driver

# Tolerance per second of device time. A crystal is accurate to about 1e-4, but a wrong unit changes
# the time by a factor of 1000.
_CLOCK_TOLERANCE = 0.02
# A stop that does not block returns much sooner; one that blocks takes much longer.
_STOP_TIMEOUT_S = 2.0
# Enough calls to hit every phase of a read, but few enough for a slow line to send every stop.
_CALL_COUNT = 50


@check(moves=False)
def samples_follow(bench: DriverBench) -> None:
    """Samples have increasing times, are read-only, and name no trajectory row at rest."""
    with bench.open_driver(to_move=False) as subject:
        first, second = subject.run(0.2), subject.run(0.2)
        require_that(len(first) > 0 and len(second) > 0, "no samples in 0.2 s", "some")
        gap_s = float(second.device_time_s[0] - first.device_time_s[-1])
        require_that(
            gap_s > 0.0, f"a sample {gap_s:g} s after the previous one", "increasing times"
        )
        rows = second.playback_row[second.playback_row != -1]
        require_that(not len(rows), f"a sample at rest names row {rows[:1]}", "-1")
        for name in ("device_time_s", "command", "measured", "inputs", "playback_row"):
            array = getattr(second, name)
            require_that(not array.flags.writeable, f"{name} can be written", "read-only arrays")


@check(moves=False)
def device_time(bench: DriverBench) -> None:
    """Device time is in seconds and advances at the rate of the host's clock."""
    with bench.open_driver(to_move=False) as subject:
        before, after = subject.run(0.1), subject.run(1.0)
        require_that(len(before) > 0 and len(after) > 0, "no samples in 1 s", "some")
        elapsed_s = float(after.device_time_s[-1] - before.device_time_s[-1])
        # Each end may be late by up to one sampling interval plus the delay of the line.
        tolerance = _CLOCK_TOLERANCE + 2.0 * (
            find_sample_interval(after) + subject.max_sample_age_s
        )
        if not subject.driver.virtual_time:
            # A real clock also advances while the processor runs other programs.
            tolerance += 0.5
        require_within(
            "in 1 s of the host the device's time advanced by", elapsed_s, 1.0, tolerance, "s"
        )


@check(moves=False)
def reading_fast(bench: DriverBench) -> None:
    """If reads are faster than the sampling of the device, no sample is returned twice."""
    with bench.open_driver(to_move=False) as subject:
        usual_s = find_sample_interval(subject.run(0.5))
        parts = []
        # Many reads are needed, since a device may report its samples in batches.
        for _ in range(300):
            subject.advance(0.1 * usual_s)
            parts += [subject.driver.read(), subject.driver.read()]
        fast = DeviceSamples.join(parts, len(subject.axes))
        intervals = np.diff(fast.device_time_s)
        shortest_s = float(intervals.min(initial=usual_s))
        # Sample times are evenly spaced within their error. A repeated sample would follow its
        # original after almost zero time.
        require_that(
            shortest_s >= 0.5 * usual_s - subject.driver.stamp_error_s,
            f"with fast reads samples are {shortest_s:.3g} s apart, usually {usual_s:.3g} s",
            "the same samples however often it is read",
        )


@check()
def stop_during_a_read(bench: DriverBench) -> None:
    """A stop in another thread returns during a read, and the axes halt."""
    with bench.open_driver() as subject:
        driver, axis = subject.driver, subject.slowest_axis
        subject.move_to_far_end(axis)
        subject.run(0.1)
        was_blocked = _call_during_read(driver, driver.stop)
        require_that(not was_blocked, "a stop waits until the read has ended", "it never waits")
        subject.run_until_idle()
        subject.require_hold()


def _call_during_read(driver: Driver, call: Callable[[], None]) -> bool:
    """Make a call in another thread during a read; return whether the read blocked it.

    The driver's clock is replaced by one whose first query during the read starts the other thread.
    So the read is always interrupted at the same place.

    Raises
    ------
    CheckNotApplicable
        If a read does not query the clock.
    """
    clock, returned = driver.clock, threading.Event()
    threads: list[threading.Thread] = []

    def run_call() -> None:
        call()
        returned.set()

    def interrupting_clock() -> float:
        # The other thread also queries the clock. It must not start another thread.
        if not threads:
            threads.append(threading.Thread(target=run_call, name="stop of a check", daemon=True))
            threads[0].start()
            returned.wait(_STOP_TIMEOUT_S)
            was_blocked.append(not returned.is_set())
        return clock()

    was_blocked: list[bool] = []
    driver.clock = interrupting_clock
    try:
        driver.read()
    finally:
        driver.clock = clock
    if not threads:
        raise CheckNotApplicable("its reads do not query the clock, so none can be interrupted")
    threads[0].join(_STOP_TIMEOUT_S)
    return was_blocked[0]


@check()
def many_threads(bench: DriverBench) -> None:
    """Several threads may call status and stop while another one reads."""
    with bench.open_driver() as subject:
        driver, errors = subject.driver, []

        def call_repeatedly() -> None:
            try:
                for _ in range(_CALL_COUNT):
                    driver.status()
                    driver.stop()
            # The check reports any exception as a failure.
            except Exception as error:
                errors.append(error)

        threads = [
            threading.Thread(target=call_repeatedly, name="caller of a check") for _ in range(3)
        ]
        for thread in threads:
            thread.start()
        try:
            while any(thread.is_alive() for thread in threads):
                subject.run(subject.step_s)
        finally:
            for thread in threads:
                thread.join()
        require_that(not errors, f"a thread raised {errors[:1]}", "no error")
        subject.run_until_idle()
