"""Checks of homing, voltages, displays and inputs."""

import numpy as np

from rotemina.drivers.abilities import (
    DISPLAY_COLUMNS,
    DISPLAY_ROWS,
    AnalogInputs,
    Display,
    Homer,
    VoltageOutput,
)
from rotemina.drivers.conformance.bench import Bench
from rotemina.drivers.conformance.check import check
from rotemina.drivers.conformance.driver_under_test import LONGEST_S, Motion, Subject
from rotemina.drivers.conformance.findings import Inapplicable, demand, refused, within
from rotemina.drivers.errors import LimitError, StateError
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.tool import ToolOutput
from rotemina.sim.robot.model import PiezoAxis

# Of a motion by a voltage alone: the hysteresis of a piezo is 15 % of its way, and it creeps.
_OPEN_LOOP_ERROR = 0.25
# Of an amplifier's range: what its monitor may say beside what was asked for.
_VOLTAGE_ERROR = 0.02


def _searcher(subject: Subject) -> tuple[Homer, Motion]:
    """Return the driver and the axis with a switch that is soonest there."""
    driver = subject.driver
    assert isinstance(driver, Homer), "a check runs where its ability is"
    able = [axis for axis in subject.axes if axis.name in driver.homing_axes]
    if not able:
        raise Inapplicable("no axis of this robot has a switch")
    return driver, min(able, key=lambda axis: axis.crossing_s)


def _searching(subject: Subject, homer: Homer, axis: Motion) -> None:
    """Have an axis look for its switch from where it is some way off."""
    at = float(subject.command()[axis.index])
    target = float(np.clip(at, axis.low + 0.05 * axis.span, axis.high - 0.05 * axis.span))
    homer.move_to({axis.name: target})
    subject.rest()
    homer.home([axis.name])
    subject.run(0.1)
    demand(subject.state is DeviceState.HOMING, f"sent home it is {subject.state}", "homing")


@check(needs=Homer)
def homing(bench: Bench) -> None:
    """After homing the position is known, the axis rests inside its range, and moves are taken."""
    with bench.opened() as subject:
        homer, axis = _searcher(subject)
        _searching(subject, homer, axis)
        subject.rest(2.0 * LONGEST_S)
        status = homer.status()
        demand(status.position_known, f"unknown after homing: {status.unhomed}", "a known position")
        subject.inside(subject.run(0.1))
        at = float(subject.command()[axis.index])
        target = subject.send(axis, axis.stroke(at))
        subject.rest()
        seen = float(subject.command()[axis.index])
        within(f"after homing axis {axis.name} goes to", seen, target, axis.half_step, axis.unit)


@check(needs=Homer)
def homing_refuses(bench: Bench) -> None:
    """While an axis looks for its switch nothing else is moved; an axis without one is refused."""
    with bench.opened() as subject:
        homer, axis = _searcher(subject)
        refused("homing of no axis", lambda: homer.home(["elbow"]), LimitError)
        _searching(subject, homer, axis)
        refused("a move while homing", lambda: homer.move_to({axis.name: axis.low}), StateError)
        refused("homing while homing", lambda: homer.home([axis.name]), StateError)
        subject.stop()
        subject.rest()


@check(needs=Homer)
def homing_stopped(bench: Bench) -> None:
    """A stop ends homing; the position stays unknown, and motion is refused until it is known."""
    with bench.opened() as subject:
        homer, axis = _searcher(subject)
        _searching(subject, homer, axis)
        subject.stop()
        subject.rest()
        subject.holds()
        status = homer.status()
        demand(
            not status.position_known and axis.name in status.unhomed,
            f"after a homing that was stopped, unknown: {status.unhomed or 'nothing'}",
            f"axis {axis.name}",
        )
        refused("a move without homing", lambda: homer.move_to({axis.name: axis.low}), StateError)


def _piezo(subject: Subject) -> tuple[Motion, PiezoAxis]:
    """Return an axis whose voltage nobody but the driver sets."""
    for axis in subject.axes:
        model = subject.driver.robot.axes[axis.name]
        if isinstance(model, PiezoAxis) and model.voltage_range and model.controller is None:
            return axis, model
    raise Inapplicable("no axis of this robot is a piezo without a controller")


@check(needs=VoltageOutput)
def voltage(bench: Bench) -> None:
    """A voltage is put out and moves the axis by its gain; the next move takes over from it."""
    with bench.opened() as subject:
        driver = subject.driver
        assert isinstance(driver, VoltageOutput), "a check runs where its ability is"
        axis, model = _piezo(subject)
        bounds = model.voltage_range
        assert bounds is not None, "such an axis was looked for"
        before = subject.run(0.2)
        at = float(before.command[-1, axis.index])
        way = axis.stroke(at)
        asked = float(np.clip((at + way) / model.gain, *bounds))
        driver.set_voltage(axis.name, asked)
        subject.rest()
        after = subject.run(0.2)
        told = float(np.median(after.inputs[:, axis.index]))
        if np.isfinite(told):
            tolerance = _VOLTAGE_ERROR * (bounds[1] - bounds[0])
            within(f"axis {axis.name} was given {asked:g} V and has", told, asked, tolerance, "V")
        ends = [float(np.median(one.measured[:, axis.index])) for one in (before, after)]
        tolerance = _OPEN_LOOP_ERROR * abs(way) + 2.0 * axis.resolution
        within(f"by a voltage axis {axis.name} went", ends[1] - ends[0], way, tolerance, axis.unit)
        driver.move_to({axis.name: at})
        subject.rest()
        seen = float(subject.command()[axis.index])
        within(f"moved again axis {axis.name} is at", seen, at, axis.half_step, axis.unit)


@check(needs=VoltageOutput)
def refused_voltages(bench: Bench) -> None:
    """A voltage beyond the amplifier's range, or of an axis without one, is refused."""
    with bench.opened() as subject:
        driver = subject.driver
        assert isinstance(driver, VoltageOutput), "a check runs where its ability is"
        axis, model = _piezo(subject)
        low, high = model.voltage_range or (0.0, 0.0)
        beyond = high + 0.01 * (high - low)
        refused("too high a voltage", lambda: driver.set_voltage(axis.name, beyond), LimitError)
        refused("a voltage of no axis", lambda: driver.set_voltage("elbow", low), LimitError)
        subject.holds()


@check(needs=Display, moves=False)
def display(bench: Bench) -> None:
    """Every row of the display takes a text of any length; a row that it has not is refused."""
    with bench.opened(to_move=False) as subject:
        driver = subject.driver
        assert isinstance(driver, Display), "a check runs where its ability is"
        for row in range(DISPLAY_ROWS):
            for text in ("", "RoTeMiNa", "x" * (DISPLAY_COLUMNS + 5), "12 µm"):
                driver.show(row, text)
                subject.run(0.05)
        refused("a row too many", lambda: driver.show(DISPLAY_ROWS, ""), LimitError)


@check(needs=AnalogInputs, moves=False)
def analog_inputs(bench: Bench) -> None:
    """Readings of potentiometers are 0 to 1, and buttons are held or not."""
    with bench.opened(to_move=False) as subject:
        driver = subject.driver
        assert isinstance(driver, AnalogInputs), "a check runs where its ability is"
        subject.run(0.2)
        readings, buttons = driver.analog_inputs()
        demand(all(0.0 <= one <= 1.0 for one in readings), f"readings {readings}", "0 to 1")
        demand(all(isinstance(one, bool) for one in buttons), f"buttons {buttons}", "true or false")


@check(needs=ToolOutput, moves=False)
def tool(bench: Bench) -> None:
    """The tool is off when the device is opened and after a stop, and on only when told so."""
    with bench.opened(to_move=False) as subject:
        driver = subject.driver
        assert isinstance(driver, ToolOutput), "a check runs where its ability is"
        demand(not driver.tool_on, "on when opened", "off")
        for on in (True, False, True):
            driver.switch_tool(on)
            subject.run(0.05)
            demand(driver.tool_on is on, f"told {on} it is {driver.tool_on}", "as it was told")
        subject.stop()
        subject.run(0.05)
        demand(not driver.tool_on, "on after a stop", "off")
    refused("a tool switched on while closed", lambda: driver.switch_tool(True), StateError)
