"""Checks of homing, voltage output, display, analog inputs and tool output."""

import numpy as np

from rotemina.drivers.abilities import (
    DISPLAY_COLUMNS,
    DISPLAY_ROWS,
    AnalogInputs,
    AxisHomer,
    TextDisplay,
    ToolOutput,
    VoltageOutput,
)
from rotemina.drivers.conformance.bench import DriverBench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import (
    MAX_MOTION_S,
    AxisUnderTest,
    DriverUnderTest,
)
from rotemina.drivers.conformance.findings import (
    CheckNotApplicable,
    require_refusal,
    require_that,
    require_within,
)
from rotemina.drivers.contract import DeviceState, LimitError, StateError
from rotemina.sim.robot import PiezoAxis

# Relative tolerance of open-loop motion: a piezo has about 15 % hysteresis, and creeps.
_OPEN_LOOP_TOLERANCE = 0.25
# Tolerance of a voltage, as a fraction of the amplifier's range.
_VOLTAGE_TOLERANCE = 0.02


def _find_homing_axis(subject: DriverUnderTest) -> tuple[AxisHomer, AxisUnderTest]:
    """Return the driver and the axis with a switch that crosses its range fastest."""
    driver = subject.driver
    assert isinstance(driver, AxisHomer), "a check runs only if the driver has the ability"
    candidates = [axis for axis in subject.axes if axis.name in driver.homing_axes]
    if not candidates:
        raise CheckNotApplicable("no axis of this robot has a switch")
    return driver, min(candidates, key=lambda axis: axis.full_range_time_s)


def _start_homing(subject: DriverUnderTest, homer: AxisHomer, axis: AxisUnderTest) -> None:
    """Move an axis clear of the ends of its range, then start to home it."""
    position = float(subject.read_command()[axis.index])
    target = float(np.clip(position, axis.low + 0.05 * axis.span, axis.high - 0.05 * axis.span))
    homer.move_to({axis.name: target})
    subject.run_until_idle()
    homer.home([axis.name])
    subject.run(0.1)
    require_that(
        subject.state is DeviceState.HOMING, f"after homing began it is {subject.state}", "homing"
    )


@check(needs=AxisHomer)
def homing(bench: DriverBench) -> None:
    """After homing the position is known, and the axis rests in its range and accepts moves."""
    with bench.open_driver() as subject:
        homer, axis = _find_homing_axis(subject)
        _start_homing(subject, homer, axis)
        subject.run_until_idle(2.0 * MAX_MOTION_S)
        status = homer.status()
        require_that(
            status.position_known,
            f"after homing the position of {status.unhomed} is unknown",
            "a known position",
        )
        subject.require_in_range(subject.run(0.1))
        position = float(subject.read_command()[axis.index])
        target = subject.move_by(axis, axis.compute_stroke(position))
        subject.run_until_idle()
        actual = float(subject.read_command()[axis.index])
        require_within(
            f"after homing axis {axis.name} ends at", actual, target, axis.half_step, axis.unit
        )


@check(needs=AxisHomer)
def homing_refuses(bench: DriverBench) -> None:
    """During homing, moves and further homing are refused. Unknown axes cannot be homed."""
    with bench.open_driver() as subject:
        homer, axis = _find_homing_axis(subject)
        require_refusal("homing of an unknown axis", lambda: homer.home(["elbow"]), LimitError)
        _start_homing(subject, homer, axis)
        require_refusal(
            "a move during homing", lambda: homer.move_to({axis.name: axis.low}), StateError
        )
        require_refusal("homing during homing", lambda: homer.home([axis.name]), StateError)
        subject.stop()
        subject.run_until_idle()


@check(needs=AxisHomer)
def homing_stopped(bench: DriverBench) -> None:
    """A stop ends homing. Then the position is unknown, and moves are refused."""
    with bench.open_driver() as subject:
        homer, axis = _find_homing_axis(subject)
        _start_homing(subject, homer, axis)
        subject.stop()
        subject.run_until_idle()
        subject.require_hold()
        status = homer.status()
        require_that(
            not status.position_known and axis.name in status.unhomed,
            f"after stopped homing the unhomed axes are {status.unhomed or 'none'}",
            f"axis {axis.name}",
        )
        require_refusal(
            "a move without homing", lambda: homer.move_to({axis.name: axis.low}), StateError
        )


def _find_piezo_axis(subject: DriverUnderTest) -> tuple[AxisUnderTest, PiezoAxis]:
    """Return a piezo axis without position controller, so that only the driver sets its voltage."""
    for axis in subject.axes:
        model = subject.driver.robot.axes[axis.name]
        if isinstance(model, PiezoAxis) and model.voltage_range and model.controller is None:
            return axis, model
    raise CheckNotApplicable("no axis of this robot is a piezo without a controller")


@check(needs=VoltageOutput)
def voltage(bench: DriverBench) -> None:
    """A voltage moves the axis according to its gain, and the next move starts from there."""
    with bench.open_driver() as subject:
        driver = subject.driver
        assert isinstance(driver, VoltageOutput), "a check runs only if the driver has the ability"
        axis, model = _find_piezo_axis(subject)
        bounds = model.voltage_range
        assert bounds is not None, "_find_piezo_axis selects an axis with a voltage range"
        before = subject.run(0.2)
        start = float(before.command[-1, axis.index])
        distance = axis.compute_stroke(start)
        requested = float(np.clip((start + distance) / model.gain, *bounds))
        driver.set_voltage(axis.name, requested)
        subject.run_until_idle()
        after = subject.run(0.2)
        reported = float(np.median(after.inputs[:, axis.index]))
        if np.isfinite(reported):
            tolerance = _VOLTAGE_TOLERANCE * (bounds[1] - bounds[0])
            require_within(
                f"axis {axis.name} was set to {requested:g} V and reports",
                reported,
                requested,
                tolerance,
                "V",
            )
        ends = [float(np.median(samples.measured[:, axis.index])) for samples in (before, after)]
        tolerance = _OPEN_LOOP_TOLERANCE * abs(distance) + 2.0 * axis.resolution
        require_within(
            f"the voltage moved axis {axis.name} by",
            ends[1] - ends[0],
            distance,
            tolerance,
            axis.unit,
        )
        driver.move_to({axis.name: start})
        subject.run_until_idle()
        actual = float(subject.read_command()[axis.index])
        require_within(
            f"after a further move axis {axis.name} is at", actual, start, axis.half_step, axis.unit
        )


@check(needs=VoltageOutput)
def refused_voltages(bench: DriverBench) -> None:
    """A voltage beyond the amplifier's range or of an unknown axis is refused."""
    with bench.open_driver() as subject:
        driver = subject.driver
        assert isinstance(driver, VoltageOutput), "a check runs only if the driver has the ability"
        axis, model = _find_piezo_axis(subject)
        low, high = model.voltage_range or (0.0, 0.0)
        beyond = high + 0.01 * (high - low)
        require_refusal(
            "too high a voltage", lambda: driver.set_voltage(axis.name, beyond), LimitError
        )
        require_refusal(
            "a voltage of an unknown axis", lambda: driver.set_voltage("elbow", low), LimitError
        )
        subject.require_hold()


@check(needs=TextDisplay, moves=False)
def display(bench: DriverBench) -> None:
    """Every row of the display accepts text of any length; a further row is refused."""
    with bench.open_driver(to_move=False) as subject:
        driver = subject.driver
        assert isinstance(driver, TextDisplay), "a check runs only if the driver has the ability"
        for row in range(DISPLAY_ROWS):
            for text in ("", "RoTeMiNa", "x" * (DISPLAY_COLUMNS + 5), "12 µm"):
                driver.show(row, text)
                subject.run(0.05)
        require_refusal("a row too many", lambda: driver.show(DISPLAY_ROWS, ""), LimitError)


@check(needs=AnalogInputs, moves=False)
def analog_inputs(bench: DriverBench) -> None:
    """Readings of potentiometers are 0 to 1, and buttons are true or false."""
    with bench.open_driver(to_move=False) as subject:
        driver = subject.driver
        assert isinstance(driver, AnalogInputs), "a check runs only if the driver has the ability"
        subject.run(0.2)
        readings, buttons = driver.analog_inputs()
        require_that(
            all(0.0 <= reading <= 1.0 for reading in readings), f"readings {readings}", "0 to 1"
        )
        require_that(
            all(isinstance(button, bool) for button in buttons),
            f"buttons {buttons}",
            "true or false",
        )


@check(needs=ToolOutput, moves=False)
def tool(bench: DriverBench) -> None:
    """The tool is off after opening and after a stop, and on only on request."""
    with bench.open_driver(to_move=False) as subject:
        driver = subject.driver
        assert isinstance(driver, ToolOutput), "a check runs only if the driver has the ability"
        require_that(not driver.tool_on, "on when opened", "off")
        for on in (True, False, True):
            driver.switch_tool(on)
            subject.run(0.05)
            require_that(
                driver.tool_on is on, f"set to {on}, it is {driver.tool_on}", "as requested"
            )
        subject.stop()
        subject.run(0.05)
        require_that(not driver.tool_on, "on after a stop", "off")
    require_refusal(
        "switching a tool on while closed", lambda: driver.switch_tool(True), StateError
    )
