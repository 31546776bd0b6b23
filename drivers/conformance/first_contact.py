"""Checks of how a driver handles damaged reports, slow lines, and pauses of the program."""

import numpy as np

from rotemina.drivers.conformance.bench import DriverBench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import STROKE_S
from rotemina.drivers.conformance.findings import (
    CheckNotApplicable,
    require_at_most,
    require_that,
    require_within,
)
from rotemina.drivers.contract import DeviceSamples, DriverError

# Maximum change between two samples, as a fraction of a move. A damaged report exceeds it.
_MAX_JUMP_RATIO = 0.5
# Longer than a device continues to move without its host, but shorter than a move through the
# whole range.
_PAUSE_S = 1.5
# Time for a driver to notice a pause and for its axes to brake.
_BRAKING_S = 0.3
# Delay in each direction, typical of a radio link or a network bridge.
_BYTE_DELAY_S = 0.1


@check(hooks=("misreport",))
def damaged_report(bench: DriverBench) -> None:
    """An impossible report is not used: a move that follows it reaches its target."""
    assert bench.misreport is not None, "a check runs only if its hooks are set"
    with bench.open_driver() as subject:
        axis = subject.slowest_axis
        start = float(subject.read_command()[axis.index])
        bench.misreport()
        reports = subject.run(0.1)
        target = start + axis.compute_stroke(start)
        bench.misreport()
        subject.driver.move_to({axis.name: target})
        reports = DeviceSamples.join([reports, subject.run_until_idle()], len(subject.axes))
        subject.require_in_range(reports)
        max_jump = float(np.abs(np.diff(reports.measured[:, axis.index])).max())
        bound = _MAX_JUMP_RATIO * abs(target - start) + axis.resolution
        require_at_most(f"the reading of axis {axis.name} jumps by", max_jump, bound, axis.unit)
        actual = float(subject.read_command()[axis.index])
        require_within(f"axis {axis.name} ends at", actual, target, axis.half_step, axis.unit)


@check(hooks=("delay_line",))
def slow_line(bench: DriverBench) -> None:
    """On a slow line either opening is refused, or moves arrive and the device is never silent."""
    assert bench.delay_line is not None, "a check runs only if its hooks are set"
    bench.delay_line(_BYTE_DELAY_S)
    try:
        if _is_opening_refused(bench):
            return
        with bench.open_driver() as subject:
            axis = subject.slowest_axis
            target = subject.move_by(
                axis, axis.compute_stroke(float(subject.read_command()[axis.index]))
            )
            max_silent_s = 0.0
            for _ in range(20):
                subject.run(0.1)
                max_silent_s = max(max_silent_s, subject.driver.status().silent_s)
            subject.run_until_idle()
            require_that(
                max_silent_s == 0.0, f"it counts as silent for {max_silent_s:.3g} s", "never"
            )
            actual = float(subject.read_command()[axis.index])
            require_within(f"axis {axis.name} ends at", actual, target, axis.half_step, axis.unit)
    finally:
        bench.delay_line(0.0)


def _is_opening_refused(bench: DriverBench) -> bool:
    driver = bench.make({})
    try:
        driver.open()
    except DriverError:
        return True
    driver.close()
    return False


@check()
def paused_program(bench: DriverBench) -> None:
    """After the program was paused during a move, nothing moves by itself."""
    with bench.open_driver() as subject:
        if subject.driver.virtual_time:
            raise CheckNotApplicable("its clock is the program's own, so there is no pause")
        subject.move_to_far_end(subject.slowest_axis)
        subject.run(STROKE_S)
        subject.advance(_PAUSE_S)
        subject.run(_BRAKING_S)
        subject.require_hold(1.0)
