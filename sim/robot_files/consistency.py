"""Checks of a robot file for values that are each valid but inconsistent with one another."""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from rotemina.sim.errors import RecordError
from rotemina.sim.messages import marked, message
from rotemina.sim.records import check_axis_name
from rotemina.sim.robot import (
    VOLTAGE_SLACK_RATIO,
    Axis,
    ForceAxis,
    PiezoAxis,
    Robot,
    StepperAxis,
    assemble_inertia_matrices,
    find_plate_problems,
)

# A range may exceed the travel that the voltage allows by this fraction of the range: drives
# saturate there. A larger difference is a wrong unit or a misplaced decimal point.
REACH_SLACK_RATIO = 0.05


class RobotProblem(NamedTuple):
    """Problem with one key of a robot file."""

    key: str
    value: object
    bound: str

    def __str__(self) -> str:
        if self.value is None:
            return message("engine", "{key}: missing; {need}").fill(key=self.key, need=self.bound)
        return message("engine", "{key} = {value}: {bound}").fill(
            key=self.key, value=str(self.value), bound=self.bound
        )


def find_problem(robot: Robot) -> RobotProblem | None:
    """Return the first inconsistency of a robot, or None."""
    for name, axis in robot.axes.items():
        for check in _AXIS_CHECKS:
            for key, value, bound in check(axis):
                return RobotProblem(f"axis.{name}.{key}", value, bound)
        try:
            check_axis_name(name, "robot.axes")
        except RecordError as error:
            return RobotProblem("robot.axes", repr(name[:40]), str(error).split("; ", 1)[-1])
    return next((p for check in _ROBOT_CHECKS for p in check(robot)), None)


def _check_ranges(axis: Axis) -> Iterator[RobotProblem]:
    if axis.range[0] >= axis.range[1]:
        yield RobotProblem(
            "range", list(axis.range), marked("engine", "the first value must be below the second")
        )
    voltage = axis.voltage_range
    if voltage is not None and voltage[0] >= voltage[1]:
        yield RobotProblem(
            "voltage_range",
            list(voltage),
            marked("engine", "the first value must be below the second"),
        )
    if axis.sensor is not None and axis.sensor.resolution >= axis.span:
        yield RobotProblem(
            "sensor.resolution",
            axis.sensor.resolution,
            message("engine", "must be below the range's {span}").fill(span=axis.span),
        )
    if axis.following_limit > axis.span:
        yield RobotProblem(
            "following_bound",
            axis.following_limit,
            message("engine", "must be at most the range's {span}").fill(span=axis.span),
        )


def _check_dynamics(axis: Axis) -> Iterator[RobotProblem]:
    modal_values = {
        "natural_frequency_hz": axis.natural_frequency_hz,
        "damping_ratio": axis.damping_ratio,
    }
    matrix_values = {"mass": axis.mass, "damping": axis.damping, "stiffness": axis.stiffness}
    given_modal_keys = [key for key, value in modal_values.items() if value is not None]
    given_matrix_keys = [key for key, value in matrix_values.items() if value is not None]
    if axis.static:
        if isinstance(axis, ForceAxis):
            yield RobotProblem(
                "static",
                True,
                marked("engine", "an axis of kind 'force' is a mass and cannot be static"),
            )
        elif given_modal_keys or given_matrix_keys:
            key = (given_modal_keys + given_matrix_keys)[0]
            yield RobotProblem(
                key,
                {**modal_values, **matrix_values}[key],
                marked("engine", "a static axis has no dynamics; remove it"),
            )
    elif given_modal_keys:
        if given_matrix_keys:
            key = given_matrix_keys[0]
            yield RobotProblem(
                key,
                matrix_values[key],
                marked(
                    "engine", "give mass, damping, stiffness or the natural frequency, not both"
                ),
            )
        for key, value in modal_values.items():
            if value is None:
                yield RobotProblem(
                    key,
                    None,
                    message("engine", "{given_modal} needs it").fill(
                        given_modal=given_modal_keys[0]
                    ),
                )
    else:
        needed = ["mass", "damping"] + ([] if isinstance(axis, ForceAxis) else ["stiffness"])
        for key in needed:
            if matrix_values[key] is None:
                yield RobotProblem(
                    key,
                    None,
                    message("engine", "an axis of kind {kind} needs it").fill(kind=repr(axis.kind)),
                )


def _check_drive(axis: Axis) -> Iterator[RobotProblem]:
    if isinstance(axis, StepperAxis):
        screw_values = {
            key: getattr(axis, key) for key in ("steps_per_rev", "microsteps_per_step", "pitch")
        }
        missing = [key for key, value in screw_values.items() if value is None]
        if missing and len(missing) < len(screw_values):
            yield RobotProblem(
                missing[0],
                None,
                message("engine", "{names} go together").fill(names=", ".join(screw_values)),
            )
        return
    if axis.gain == 0.0:
        yield RobotProblem("gain", axis.gain, marked("engine", "must not be zero"))
    elif isinstance(axis, PiezoAxis) and axis.voltage_range is not None:
        yield from _check_reach(axis)
    if axis.controller is not None and axis.static:
        yield RobotProblem(
            "controller",
            axis.controller.kind,
            marked("engine", "a static axis has nothing to control"),
        )
    if axis.controller is not None and axis.voltage_range is not None:
        max_voltage = max(abs(bound) for bound in axis.voltage_range)
        if axis.controller.limit > max_voltage * (1 + VOLTAGE_SLACK_RATIO):
            yield RobotProblem(
                "controller.limit",
                axis.controller.limit,
                message("engine", "must be at most {largest} V, the end of voltage_range").fill(
                    largest=max_voltage
                ),
            )


def _check_reach(axis: PiezoAxis) -> Iterator[RobotProblem]:
    assert axis.voltage_range is not None
    low, high = sorted(axis.gain * bound for bound in axis.voltage_range)
    slack = REACH_SLACK_RATIO * axis.span
    if axis.range[0] < low - slack or axis.range[1] > high + slack:
        yield RobotProblem(
            "range",
            list(axis.range),
            message(
                "engine", "gain {gain} over voltage_range {ends} reaches only {low} to {high}"
            ).fill(gain=axis.gain, ends=str(list(axis.voltage_range)), low=low, high=high),
        )


def _check_stages(robot: Robot) -> Iterator[RobotProblem]:
    stage_of: dict[str, str] = {}
    for stage, names in robot.stages.items():
        for name in names:
            if name not in robot.axes:
                yield RobotProblem(
                    f"robot.stages.{stage}",
                    name,
                    message("engine", "must be one of {names}").fill(names=str(list(robot.axes))),
                )
            if name in stage_of:
                yield RobotProblem(
                    f"robot.stages.{stage}",
                    name,
                    message("engine", "is in stage {seen} already").fill(seen=stage_of[name]),
                )
            stage_of[name] = stage


def _check_couplings(robot: Robot) -> Iterator[RobotProblem]:
    seen_couplings = set()
    for index, coupling in enumerate(robot.couplings):
        key = f"coupling[{index}].axes"
        pair = list(coupling.axes)
        for name in pair:
            if name not in robot.axes:
                yield RobotProblem(
                    key,
                    name,
                    message("engine", "must be one of {names}").fill(names=str(list(robot.axes))),
                )
                return
            if robot.axes[name].static:
                yield RobotProblem(
                    key, name, marked("engine", "a static axis has no dynamics to couple")
                )
        if pair[0] == pair[1]:
            yield RobotProblem(key, pair, marked("engine", "must name two different axes"))
        if (coupling.matrix, frozenset(pair)) in seen_couplings:
            yield RobotProblem(
                key,
                pair,
                message("engine", "couples these axes in {matrix} a second time").fill(
                    matrix=coupling.matrix
                ),
            )
        seen_couplings.add((coupling.matrix, frozenset(pair)))


def _check_plate(robot: Robot) -> Iterator[RobotProblem]:
    for key, value, bound in find_plate_problems(robot.plate):
        yield RobotProblem(f"plate.{key}", value, bound)


def _check_definiteness(robot: Robot) -> Iterator[RobotProblem]:
    names, mass, damping, stiffness = assemble_inertia_matrices(robot)
    if not names:
        return
    for matrix, letter, must_be_definite in (
        (mass, "M", True),
        (damping, "D", False),
        (stiffness, "C", False),
    ):
        scale = 1.0 / np.sqrt(np.where(np.diag(matrix) > 0, np.diag(matrix), 1.0))
        smallest_eigenvalue = float(np.linalg.eigvalsh(matrix * np.outer(scale, scale))[0])
        if smallest_eigenvalue < (1e-9 if must_be_definite else -1e-9):
            values = [c.value for c in robot.couplings if c.matrix == letter]
            word = "definite" if must_be_definite else "semi-definite"
            yield RobotProblem(
                "coupling",
                values,
                message(
                    "engine", "{letter} must be positive {word}; make the coupling smaller"
                ).fill(letter=letter, word=word),
            )


_AXIS_CHECKS: tuple[Callable[[Axis], Iterator[RobotProblem]], ...] = (
    _check_ranges,
    _check_dynamics,
    _check_drive,
)
_ROBOT_CHECKS: tuple[Callable[[Robot], Iterator[RobotProblem]], ...] = (
    _check_stages,
    _check_couplings,
    _check_plate,
    _check_definiteness,
)
