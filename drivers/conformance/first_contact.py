"""Checks of what real lines and computers do: damaged reports, slow lines, pauses."""

import numpy as np

from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import CATCH_S
from rotemina.drivers.conformance.findings import Inapplicable, at_most, demand, within
from rotemina.drivers.errors import DriverError
from rotemina.drivers.samples import Samples

# Of a move: what no axis does from one sample to the next. A report that cannot be true is farther.
_JUMP = 0.5
# Longer than a device moves on without its host, shorter than a move through a whole range.
_PAUSE_S = 1.5
# In which a driver may notice a pause, and its axes brake.
_BRAKING_S = 0.3
# Each way: a radio link, or a bridge over a network.
_DELAY_S = 0.1


@check(hooks=("misreport",))
def damaged_report(bench: Bench) -> None:
    """A report that cannot be true is not used: a move after it goes where it is sent."""
    assert bench.misreport is not None, "a check runs where its hooks are"
    with bench.opened() as subject:
        axis = subject.slow
        start = float(subject.command()[axis.index])
        bench.misreport()
        reports = subject.run(0.1)
        target = start + axis.stroke(start)
        bench.misreport()
        subject.driver.move_to({axis.name: target})
        reports = Samples.joined([reports, subject.rest()], len(subject.axes))
        subject.inside(reports)
        jump = float(np.abs(np.diff(reports.measured[:, axis.index])).max())
        bound = _JUMP * abs(target - start) + axis.resolution
        at_most(f"axis {axis.name} reads a jump of", jump, bound, axis.unit)
        seen = float(subject.command()[axis.index])
        within(f"axis {axis.name} ends at", seen, target, axis.half_step, axis.unit)


@check(hooks=("delay_line",))
def slow_line(bench: Bench) -> None:
    """On a slow line moves arrive, and the device is never silent; or opening is refused."""
    assert bench.delay_line is not None, "a check runs where its hooks are"
    bench.delay_line(_DELAY_S)
    try:
        if _is_refused(bench):
            return
        with bench.opened() as subject:
            axis = subject.slow
            target = subject.send(axis, axis.stroke(float(subject.command()[axis.index])))
            silent_s = 0.0
            for _ in range(20):
                subject.run(0.1)
                silent_s = max(silent_s, subject.driver.status().silent_s)
            subject.rest()
            demand(silent_s == 0.0, f"it counts as silent for {silent_s:.3g} s", "never")
            seen = float(subject.command()[axis.index])
            within(f"axis {axis.name} ends at", seen, target, axis.half_step, axis.unit)
    finally:
        bench.delay_line(0.0)


def _is_refused(bench: Bench) -> bool:
    """Return whether the device cannot be opened now."""
    driver = bench.make({})
    try:
        driver.open()
    except DriverError:
        return True
    driver.close()
    return False


@check()
def paused_program(bench: Bench) -> None:
    """After a pause of the program in mid-move nothing goes on by itself."""
    with bench.opened() as subject:
        if subject.driver.virtual_time:
            raise Inapplicable("its time is the program's own: there is no pause")
        subject.cross(subject.slow)
        subject.run(CATCH_S)
        subject.advance(_PAUSE_S)
        subject.run(_BRAKING_S)
        subject.holds(1.0)
