"""Checks of creating, opening and closing a driver, and of its settings and descriptions."""

from collections.abc import Callable

import numpy as np

from rotemina.drivers.abilities import (
    AxisHomer,
    FastCapturer,
    ProfileRunner,
    TextDisplay,
    VelocityMover,
)
from rotemina.drivers.conformance.bench import DriverBench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.findings import (
    CheckNotApplicable,
    require_at_most,
    require_refusal,
    require_that,
    require_within,
)
from rotemina.drivers.contract import (
    DeviceState,
    Driver,
    DriverError,
    DriverSettingError,
    MachineKind,
    StateError,
)
from rotemina.sim.trajectory import RANGE_SLACK_RATIO

# Maximum motion of an axis at rest, due to noise and vibration, as a fraction of its span.
_MAX_REST_MOTION_RATIO = 5e-3


@check(moves=False)
def making(bench: DriverBench) -> None:
    """Creating a driver opens nothing and sends nothing."""
    driver = bench.make({})
    state = driver.status().state
    require_that(state is DeviceState.CLOSED, f"the state of a new driver is {state}", "closed")
    if bench.was_device_contacted is not None:
        require_that(
            not bench.was_device_contacted(),
            "creating it reached the device",
            "no exchange before open",
        )


@check(moves=False)
def settings(bench: DriverBench) -> None:
    """A setting must have the type of its default; unknown settings are refused."""
    driver = bench.make({})
    require_refusal(
        "a setting 'velocity_of_light'",
        lambda: bench.make({"velocity_of_light": 1}),
        DriverSettingError,
    )
    for name in driver.default_settings:
        try:
            bench.make({name: ["no", "scalar"]})
        except DriverSettingError as error:
            require_that(
                name in str(error), f"the error for setting {name} says {error}", "its name"
            )
        else:
            require_that(False, f"setting {name} accepted a list", "DriverSettingError")


@check(moves=False)
def closed_refuses(bench: DriverBench) -> None:
    """A closed driver refuses everything except stop and close."""
    driver = bench.make({})
    for name, call in _list_requests(driver).items():
        require_refusal(f"{name} of a closed driver", call, StateError)
    driver.stop()
    driver.close()


def _list_requests(driver: Driver) -> dict[str, Callable[[], object]]:
    axis = driver.axes[0]
    requests: dict[str, Callable[[], object]] = {
        "read": driver.read,
        "clear_fault": driver.clear_fault,
        "move_to": lambda: driver.move_to({axis: driver.robot.axes[axis].range[0]}),
    }
    if isinstance(driver, VelocityMover):
        requests["move_velocity"] = lambda: driver.move_velocity({axis: 0.0}, 0.1)
    if isinstance(driver, AxisHomer):
        requests["home"] = lambda: driver.home(driver.homing_axes)
    if isinstance(driver, FastCapturer):
        requests["capture"] = lambda: driver.capture([axis], 1.0, 1)
    if isinstance(driver, ProfileRunner):
        requests["trigger"] = driver.trigger
    if isinstance(driver, TextDisplay):
        requests["show"] = lambda: driver.show(0, "")
    return requests


@check(moves=False)
def closing_twice(bench: DriverBench) -> None:
    """Closing may be repeated, and a closed driver may be stopped."""
    driver = bench.make({})
    driver.open()
    driver.close()
    require_that(
        driver.status().state is DeviceState.CLOSED, "after close it is not closed", "closed"
    )
    driver.close()
    driver.stop()


@check(moves=False)
def opening_twice(bench: DriverBench) -> None:
    """Opening an open driver is refused and changes nothing."""
    with bench.open_driver(to_move=False) as subject:
        require_refusal("a second open", subject.driver.open, StateError)
        state = subject.state
        require_that(
            state is not DeviceState.CLOSED, f"after a refused open it is {state}", "still open"
        )
        subject.require_hold()


@check(moves=False)
def reopening(bench: DriverBench) -> None:
    """A driver that was closed can be opened again, and its axes have not moved."""
    with bench.open_driver(to_move=False) as subject:
        before = subject.read_command()
        subject.driver.close()
        subject.driver.open()
        after = subject.read_command()
        for axis in subject.axes if subject.driver.status().position_known else ():
            actual, expected = float(after[axis.index]), float(before[axis.index])
            require_within(
                f"after reopening axis {axis.name} is at",
                actual,
                expected,
                axis.half_step,
                axis.unit,
            )


@check(moves=False)
def identity(bench: DriverBench) -> None:
    """The driver counts as a real machine until it reports its kind, which never changes."""
    driver = bench.make({})
    kind_before = driver.machine_kind
    require_that(
        kind_before is not MachineKind.VIRTUAL,
        f"before it was opened it is {kind_before}",
        f"{MachineKind.REAL}, or {MachineKind.SIMULATED} where the driver has no device",
    )
    with bench.open_driver(to_move=False) as subject:
        driver = subject.driver
        first_kind = driver.machine_kind
        require_that(
            (first_kind is MachineKind.SIMULATED) == (kind_before is MachineKind.SIMULATED),
            f"it is {kind_before} before it is opened and {first_kind} afterwards",
            "simulated both times or never",
        )
        driver.close()
        kind_after_close = driver.machine_kind
        require_that(
            kind_after_close is first_kind,
            f"after closing it is {kind_after_close}",
            f"{first_kind}, as while it was open",
        )
        try:
            driver.open()
        # Another check covers reopening.
        except DriverError as error:
            raise CheckNotApplicable(f"it could not be opened again: {error}") from error
        reopened_kind = driver.machine_kind
        require_that(
            reopened_kind is first_kind,
            f"after reopening it is {reopened_kind}",
            f"{first_kind}, as before",
        )


@check(moves=False)
def opens_at_rest(bench: DriverBench) -> None:
    """After opening the device is at rest, inside the range if the position is known."""
    with bench.open_driver(to_move=False) as subject:
        subject.run(0.05)
        samples = subject.run(0.5)
        require_that(len(samples) >= 3, f"{len(samples)} samples in 0.5 s", "3 or more")
        state = subject.state
        require_that(state is DeviceState.IDLE, f"after open it is {state}", "idle")
        if subject.driver.status().position_known:
            subject.require_in_range(samples)
        for axis in subject.axes:
            travel = float(np.ptp(samples.command[:, axis.index]))
            require_at_most(
                f"axis {axis.name} is commanded to move by", travel, axis.half_step, axis.unit
            )
            change = float(np.ptp(samples.measured[:, axis.index]))
            bound = _MAX_REST_MOTION_RATIO * axis.span + 2.0 * axis.resolution
            require_at_most(
                f"the reading of axis {axis.name} at rest changes by", change, bound, axis.unit
            )


@check(moves=False)
def descriptions(bench: DriverBench) -> None:
    """The axes are those of the robot file, in the same order and units, with no wider ranges."""
    driver = bench.make({})
    names = [description.name for description in driver.descriptions]
    require_that(names == list(driver.axes), f"it describes {names}", f"{list(driver.axes)}")
    for description in driver.descriptions:
        axis = driver.robot.axes[description.name]
        require_that(
            description.kind == axis.kind,
            f"axis {description.name} is a {description.kind}",
            axis.kind,
        )
        unit = driver.robot.unit(description.name) or ""
        require_that(
            description.unit == unit, f"axis {description.name} is in {description.unit}", unit
        )
        low, high = axis.range
        # The device's range is rounded to whole steps.
        slack = RANGE_SLACK_RATIO * axis.span + description.resolution
        require_that(
            low - slack <= description.low < description.high <= high + slack,
            f"axis {description.name} has the range {description.low:g} to {description.high:g} "
            f"{unit}",
            f"{low:g} to {high:g} {unit}, or less",
        )
        # An axis with fewer than 100 steps could not be positioned usefully.
        require_at_most(
            f"the step of axis {description.name} is",
            description.resolution,
            0.01 * axis.span,
            unit,
        )
        require_that(
            description.resolution >= 0.0,
            f"the step of axis {description.name} is negative",
            "0 or more",
        )


@check(moves=False)
def clearing_nothing(bench: DriverBench) -> None:
    """Clearing a fault has no effect if there is no fault."""
    with bench.open_driver(to_move=False) as subject:
        before = subject.state
        subject.driver.clear_fault()
        require_that(
            subject.state is before, f"it changed from {before} to {subject.state}", "no change"
        )
        subject.require_hold()


@check(hooks=("cause_fault",))
def fault(bench: DriverBench) -> None:
    """A fault has a reason and blocks motion; after clearing it the device is idle and holds."""
    assert bench.cause_fault is not None, "a check runs only if its hooks are set"
    with bench.open_driver() as subject:
        driver = subject.driver
        bench.cause_fault(driver)
        subject.run(0.1)
        status = driver.status()
        require_that(status.state is DeviceState.FAULT, f"in a fault it is {status.state}", "fault")
        require_that(bool(status.fault), "the fault has no reason", "a reason for the fault")
        axis = subject.axes[0]
        require_refusal(
            "a move in a fault", lambda: driver.move_to({axis.name: axis.low}), StateError
        )
        driver.clear_fault()
        subject.run(0.1)
        require_that(
            subject.state is DeviceState.IDLE, f"after clearing it is {subject.state}", "idle"
        )
        subject.require_hold()
