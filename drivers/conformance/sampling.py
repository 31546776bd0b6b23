"""Checks of a driver's samples, and of concurrent calls from several threads."""

import threading
from collections.abc import Callable

import numpy as np

from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import interval_of
from rotemina.drivers.conformance.findings import Inapplicable, demand, within
from rotemina.drivers.driver import Driver
from rotemina.drivers.samples import Samples

# A device's crystal is right to some 1e-4; a factor of a thousand is what is looked for.
_CLOCK_ERROR = 0.02
# Far longer than any stop takes that does not wait, far shorter than somebody waits for one.
_PATIENCE_S = 2.0
# Enough to meet reads at any place, few enough for a line that must carry each stop.
_CALLS = 50


@check(moves=False)
def samples_follow(bench: Bench) -> None:
    """Samples follow one another, cannot be written, and belong to no trajectory at rest."""
    with bench.opened(to_move=False) as subject:
        first, second = subject.run(0.2), subject.run(0.2)
        demand(len(first) > 0 and len(second) > 0, "no samples in 0.2 s", "some")
        gap_s = float(second.device_time_s[0] - first.device_time_s[-1])
        demand(gap_s > 0.0, f"a sample {gap_s:g} s after the one before", "later ones")
        rows = second.playback_row[second.playback_row != -1]
        demand(not len(rows), f"a sample at rest names row {rows[:1]}", "-1")
        for name in ("device_time_s", "command", "measured", "inputs", "playback_row"):
            array = getattr(second, name)
            demand(not array.flags.writeable, f"{name} can be written", "read-only arrays")


@check(moves=False)
def device_time(bench: Bench) -> None:
    """Device time passes as the clock does, in seconds."""
    with bench.opened(to_move=False) as subject:
        first, rest = subject.run(0.1), subject.run(1.0)
        demand(len(first) > 0 and len(rest) > 0, "no samples in 1 s", "some")
        passed = float(rest.device_time_s[-1] - first.device_time_s[-1])
        # Both ends are late by up to a sample and by what the line takes.
        tolerance = _CLOCK_ERROR + 2.0 * (interval_of(rest) + subject.late_s)
        if not subject.driver.virtual_time:
            tolerance += 0.5  # a real clock goes on while others have the processor
        within("in 1 s of the host the device's time went on by", passed, 1.0, tolerance, "s")


@check(moves=False)
def reading_fast(bench: Bench) -> None:
    """Reading faster than the device samples gives no sample twice."""
    with bench.opened(to_move=False) as subject:
        usual_s = interval_of(subject.run(0.5))
        parts = []
        for _ in range(300):  # devices may tell samples in portions
            subject.advance(0.1 * usual_s)
            parts += [subject.driver.read(), subject.driver.read()]
        fast = Samples.joined(parts, len(subject.axes))
        intervals = np.diff(fast.device_time_s)
        shortest = float(intervals.min(initial=usual_s))
        # Samples of one device come evenly, as well as they are dated; twice the same would follow
        # itself at once.
        demand(
            shortest >= 0.5 * usual_s - subject.driver.stamp_error_s,
            f"read fast, samples come {shortest:.3g} s apart, usually {usual_s:.3g} s",
            "the same samples however often one reads",
        )


@check()
def stop_during_a_read(bench: Bench) -> None:
    """Another thread's stop returns while a read is under way, and the axes halt."""
    with bench.opened() as subject:
        driver, axis = subject.driver, subject.slow
        subject.cross(axis)
        subject.run(0.1)
        waited = _during_a_read(driver, driver.stop)
        demand(not waited, "stop waits until the read has ended", "it never waits")
        subject.rest()
        subject.holds()


def _during_a_read(driver: Driver, call: Callable[[], None]) -> bool:
    """Let another thread call while the driver reads; return whether the call had to wait.

    The driver's clock is where a read can be met in its middle, without any chance in it: the
    first look at it starts the thread and gives it time.

    Raises
    ------
    Inapplicable
        If the driver reads without looking at the clock.
    """
    clock, returned = driver.clock, threading.Event()
    threads: list[threading.Thread] = []

    def called() -> None:
        call()
        returned.set()

    def met() -> float:
        # The other thread looks at the clock too, and must not start another one.
        if not threads:
            threads.append(threading.Thread(target=called, name="stop of a check", daemon=True))
            threads[0].start()
            returned.wait(_PATIENCE_S)
            waited.append(not returned.is_set())
        return clock()

    waited: list[bool] = []
    driver.clock = met
    try:
        driver.read()
    finally:
        driver.clock = clock
    if not threads:
        raise Inapplicable("its reads do not look at the clock, so none can be met in its middle")
    threads[0].join(_PATIENCE_S)
    return waited[0]


@check()
def many_threads(bench: Bench) -> None:
    """Status and stop may be called by several threads while another one reads."""
    with bench.opened() as subject:
        driver, raised = subject.driver, []

        def ask() -> None:
            try:
                for _ in range(_CALLS):
                    driver.status()
                    driver.stop()
            except Exception as error:  # whatever it is, the check says so
                raised.append(error)

        # Short-lived threads, for what is checked is what happens between threads.
        threads = [threading.Thread(target=ask, name="asker of a check") for _ in range(3)]
        for thread in threads:
            thread.start()
        try:
            while any(thread.is_alive() for thread in threads):
                subject.run(subject.step_s)
        finally:
            for thread in threads:
                thread.join()
        demand(not raised, f"a thread met {raised[:1]}", "no error")
        subject.rest()
