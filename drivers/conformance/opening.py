"""Checks of creating, opening and closing a driver, its settings and its description."""

from collections.abc import Callable

import numpy as np

from rotemina.drivers.abilities import (
    Capturer,
    Display,
    Homer,
    ProfileRunner,
    VelocityMover,
)
from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.findings import Inapplicable, at_most, demand, refused, within
from rotemina.drivers.driver import Driver, MachineKind
from rotemina.drivers.errors import DriverError, StateError
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.settings import SettingError
from rotemina.sim.trajectory.axis_limits import RANGE_SLACK

# Of the span: what an axis at rest may seem to move by its sensor's noise and its vibration.
_STILL = 5e-3


@check(moves=False)
def making(bench: Bench) -> None:
    """Making a driver opens nothing and touches nothing."""
    driver = bench.make({})
    state = driver.status().state
    demand(state is DeviceState.CLOSED, f"the state of a new driver is {state}", "closed")
    if bench.touched is not None:
        demand(not bench.touched(), "making it has reached the device", "no exchange before open")


@check(moves=False)
def settings(bench: Bench) -> None:
    """Settings have the type of their default; an unknown one, or another type, is refused."""
    driver = bench.make({})
    refused(
        "a setting 'velocity_of_light'", lambda: bench.make({"velocity_of_light": 1}), SettingError
    )
    for name in driver.default_settings:
        try:
            bench.make({name: ["no", "scalar"]})
        except SettingError as error:
            demand(name in str(error), f"the refusal of a bad {name} says {error}", "its name")
        else:
            demand(False, f"setting {name} took a list", "SettingError")


@check(moves=False)
def closed_refuses(bench: Bench) -> None:
    """A closed driver refuses all but stop and close."""
    driver = bench.make({})
    for what, call in _requests(driver).items():
        refused(f"{what} of a closed driver", call, StateError)
    driver.stop()
    driver.close()


def _requests(driver: Driver) -> dict[str, Callable[[], object]]:
    """Return what can be asked of a driver, by its name."""
    axis = driver.axes[0]
    requests: dict[str, Callable[[], object]] = {
        "read": driver.read,
        "clear_fault": driver.clear_fault,
        "move_to": lambda: driver.move_to({axis: driver.robot.axes[axis].range[0]}),
    }
    if isinstance(driver, VelocityMover):
        requests["move_velocity"] = lambda: driver.move_velocity({axis: 0.0}, 0.1)
    if isinstance(driver, Homer):
        requests["home"] = lambda: driver.home(driver.homing_axes)
    if isinstance(driver, Capturer):
        requests["capture"] = lambda: driver.capture([axis], 1.0, 1)
    if isinstance(driver, ProfileRunner):
        requests["trigger"] = driver.trigger
    if isinstance(driver, Display):
        requests["show"] = lambda: driver.show(0, "")
    return requests


@check(moves=False)
def closing_twice(bench: Bench) -> None:
    """Closing succeeds, leaves the driver closed, and may be done again; so may stopping."""
    driver = bench.make({})
    driver.open()
    driver.close()
    demand(driver.status().state is DeviceState.CLOSED, "after close it is open", "closed")
    driver.close()
    driver.stop()


@check(moves=False)
def opening_twice(bench: Bench) -> None:
    """Opening what is open is refused, and changes nothing."""
    with bench.opened(to_move=False) as subject:
        refused("a second open", subject.driver.open, StateError)
        state = subject.state
        demand(state is not DeviceState.CLOSED, f"after a refused open it is {state}", "open still")
        subject.holds()


@check(moves=False)
def reopening(bench: Bench) -> None:
    """A driver that was closed can be opened again, and its axes stand where they stood."""
    with bench.opened(to_move=False) as subject:
        before = subject.command()
        subject.driver.close()
        subject.driver.open()
        after = subject.command()
        for axis in subject.axes if subject.driver.status().position_known else ():
            seen, expected = float(after[axis.index]), float(before[axis.index])
            within(f"axis {axis.name} reopened at", seen, expected, axis.half_step, axis.unit)


@check(moves=False)
def identity(bench: Bench) -> None:
    """It is a real machine until it says otherwise, and says the same each time it is opened."""
    driver = bench.make({})
    before = driver.machine_kind
    demand(
        before is not MachineKind.VIRTUAL,
        f"before it was opened it is {before}",
        f"{MachineKind.REAL}, or {MachineKind.SIMULATED} where the driver has no device",
    )
    with bench.opened(to_move=False) as subject:
        driver = subject.driver
        first = driver.machine_kind
        demand(
            (first is MachineKind.SIMULATED) == (before is MachineKind.SIMULATED),
            f"it is {before} before it is opened and {first} afterwards",
            "simulated both times or never",
        )
        driver.close()
        closed = driver.machine_kind
        demand(closed is first, f"closed it is {closed}", f"{first}, as while it was open")
        try:
            driver.open()
        except DriverError as error:  # the matter of another check
            raise Inapplicable(f"it could not be opened again: {error}") from error
        again = driver.machine_kind
        demand(again is first, f"opened again it is {again}", f"{first}, as at first")


@check(moves=False)
def opens_at_rest(bench: Bench) -> None:
    """It opens at rest, inside the range where it knows its position, and holds."""
    with bench.opened(to_move=False) as subject:
        subject.run(0.05)
        samples = subject.run(0.5)
        demand(len(samples) >= 3, f"{len(samples)} samples in 0.5 s", "3 or more")
        state = subject.state
        demand(state is DeviceState.IDLE, f"after open it is {state}", "idle")
        if subject.driver.status().position_known:
            subject.inside(samples)
        for axis in subject.axes:
            moved = float(np.ptp(samples.command[:, axis.index]))
            at_most(f"axis {axis.name} is commanded to move by", moved, axis.half_step, axis.unit)
            still = float(np.ptp(samples.measured[:, axis.index]))
            bound = _STILL * axis.span + 2.0 * axis.resolution
            at_most(f"axis {axis.name} at rest is measured to move by", still, bound, axis.unit)


@check(moves=False)
def descriptions(bench: Bench) -> None:
    """Its axes are those of the robot file, in order, in m or rad, no wider than there."""
    driver = bench.make({})
    names = [one.name for one in driver.descriptions]
    demand(names == list(driver.axes), f"it describes {names}", f"{list(driver.axes)}")
    for one in driver.descriptions:
        axis = driver.robot.axes[one.name]
        demand(one.kind == axis.kind, f"axis {one.name} is a {one.kind}", axis.kind)
        unit = driver.robot.unit(one.name) or ""
        demand(one.unit == unit, f"axis {one.name} is in {one.unit}", unit)
        low, high = axis.range
        slack = RANGE_SLACK * axis.span + one.resolution  # a device counts whole steps
        demand(
            low - slack <= one.low < one.high <= high + slack,
            f"axis {one.name} goes from {one.low:g} to {one.high:g} {unit}",
            f"{low:g} to {high:g} {unit}, or less",
        )
        # An axis of fewer steps than this could not be positioned at all.
        at_most(f"the step of axis {one.name} is", one.resolution, 0.01 * axis.span, unit)
        demand(one.resolution >= 0.0, f"the step of axis {one.name} is negative", "0 or more")


@check(moves=False)
def clearing_nothing(bench: Bench) -> None:
    """Clearing a fault where there is none does nothing."""
    with bench.opened(to_move=False) as subject:
        before = subject.state
        subject.driver.clear_fault()
        demand(subject.state is before, f"it went from {before} to {subject.state}", "no change")
        subject.holds()


@check(hooks=("cause_fault",))
def fault(bench: Bench) -> None:
    """A fault is named and refuses motion; cleared, the device is idle and holds."""
    assert bench.cause_fault is not None, "a check runs where its hooks are"
    with bench.opened() as subject:
        driver = subject.driver
        bench.cause_fault(driver)
        subject.run(0.1)
        status = driver.status()
        demand(status.state is DeviceState.FAULT, f"in a fault it is {status.state}", "fault")
        demand(bool(status.fault), "the fault has no name", "why the device is in it")
        axis = subject.axes[0]
        refused("a move in a fault", lambda: driver.move_to({axis.name: axis.low}), StateError)
        driver.clear_fault()
        subject.run(0.1)
        demand(subject.state is DeviceState.IDLE, f"cleared it is {subject.state}", "idle")
        subject.holds()
