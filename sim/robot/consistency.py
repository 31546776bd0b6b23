"""Values of a robot file that are possible one by one but not together."""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from rotemina.sim.messages import marked, message
from rotemina.sim.plate.geometry import impossible
from rotemina.sim.records.layout import check_axis_name
from rotemina.sim.records.record import RecordError
from rotemina.sim.robot.matrices import inertia_matrices
from rotemina.sim.robot.model import (
    VOLTAGE_SLACK,
    Axis,
    ForceAxis,
    PiezoAxis,
    Robot,
    StepperAxis,
)

# A range may exceed what the voltage reaches by this share of it: drives saturate there, but a
# larger difference is a slip of the unit or of the decimal point.
REACH_SLACK = 0.05


class Problem(NamedTuple):
    """A problem with one key of a robot file."""

    key: str
    value: object
    bound: str

    def __str__(self) -> str:
        if self.value is None:
            return message("engine", "{key}: missing; {need}").fill(key=self.key, need=self.bound)
        return message("engine", "{key} = {value}: {bound}").fill(
            key=self.key, value=str(self.value), bound=self.bound
        )


def find_problem(robot: Robot) -> Problem | None:
    """Return the first inconsistency of a robot, or None."""
    for name, axis in robot.axes.items():
        for check in _AXIS_CHECKS:
            for key, value, bound in check(axis):
                return Problem(f"axis.{name}.{key}", value, bound)
        try:
            check_axis_name(name, "robot.axes")
        except RecordError as error:
            return Problem("robot.axes", repr(name[:40]), str(error).split("; ", 1)[-1])
    return next((p for check in _ROBOT_CHECKS for p in check(robot)), None)


def _ranges(axis: Axis) -> Iterator[Problem]:
    if axis.range[0] >= axis.range[1]:
        yield Problem(
            "range", list(axis.range), marked("engine", "the first value must be below the second")
        )
    voltage = axis.voltage_range
    if voltage is not None and voltage[0] >= voltage[1]:
        yield Problem(
            "voltage_range",
            list(voltage),
            marked("engine", "the first value must be below the second"),
        )
    if axis.sensor is not None and axis.sensor.resolution >= axis.span:
        yield Problem(
            "sensor.resolution",
            axis.sensor.resolution,
            message("engine", "must be below the range's {span}").fill(span=axis.span),
        )
    if axis.following > axis.span:
        yield Problem(
            "following_bound",
            axis.following,
            message("engine", "must be at most the range's {span}").fill(span=axis.span),
        )


def _dynamics(axis: Axis) -> Iterator[Problem]:
    modal = {
        "natural_frequency_hz": axis.natural_frequency_hz,
        "damping_ratio": axis.damping_ratio,
    }
    plain = {"mass": axis.mass, "damping": axis.damping, "stiffness": axis.stiffness}
    given_modal = [key for key, value in modal.items() if value is not None]
    given_plain = [key for key, value in plain.items() if value is not None]
    if axis.static:
        if isinstance(axis, ForceAxis):
            yield Problem(
                "static",
                True,
                marked("engine", "an axis of kind 'force' is a mass and cannot be static"),
            )
        elif given_modal or given_plain:
            key = (given_modal + given_plain)[0]
            yield Problem(
                key,
                {**modal, **plain}[key],
                marked("engine", "a static axis has no dynamics; remove it"),
            )
    elif given_modal:
        if given_plain:
            key = given_plain[0]
            yield Problem(
                key,
                plain[key],
                marked(
                    "engine", "give mass, damping, stiffness or the natural frequency, not both"
                ),
            )
        for key, value in modal.items():
            if value is None:
                yield Problem(
                    key,
                    None,
                    message("engine", "{given_modal} needs it").fill(given_modal=given_modal[0]),
                )
    else:
        needed = ["mass", "damping"] + ([] if isinstance(axis, ForceAxis) else ["stiffness"])
        for key in needed:
            if plain[key] is None:
                yield Problem(
                    key,
                    None,
                    message("engine", "an axis of kind {kind} needs it").fill(kind=repr(axis.kind)),
                )


def _drive(axis: Axis) -> Iterator[Problem]:
    if isinstance(axis, StepperAxis):
        gear = {
            key: getattr(axis, key) for key in ("steps_per_rev", "microsteps_per_step", "pitch")
        }
        missing = [key for key, value in gear.items() if value is None]
        if missing and len(missing) < len(gear):
            yield Problem(
                missing[0],
                None,
                message("engine", "{names} go together").fill(names=", ".join(gear)),
            )
        return
    if axis.gain == 0.0:
        yield Problem("gain", axis.gain, marked("engine", "must not be zero"))
    elif isinstance(axis, PiezoAxis) and axis.voltage_range is not None:
        yield from _reach(axis)
    if axis.controller is not None and axis.static:
        yield Problem(
            "controller",
            axis.controller.kind,
            marked("engine", "a static axis has nothing to control"),
        )
    if axis.controller is not None and axis.voltage_range is not None:
        largest = max(abs(bound) for bound in axis.voltage_range)
        if axis.controller.limit > largest * (1 + VOLTAGE_SLACK):
            yield Problem(
                "controller.limit",
                axis.controller.limit,
                message("engine", "must be at most {largest} V, the end of voltage_range").fill(
                    largest=largest
                ),
            )


def _reach(axis: PiezoAxis) -> Iterator[Problem]:
    assert axis.voltage_range is not None
    low, high = sorted(axis.gain * bound for bound in axis.voltage_range)
    slack = REACH_SLACK * axis.span
    if axis.range[0] < low - slack or axis.range[1] > high + slack:
        yield Problem(
            "range",
            list(axis.range),
            message(
                "engine", "gain {gain} over voltage_range {ends} reaches only {low} to {high}"
            ).fill(gain=axis.gain, ends=str(list(axis.voltage_range)), low=low, high=high),
        )


def _stages(robot: Robot) -> Iterator[Problem]:
    seen: dict[str, str] = {}
    for stage, names in robot.stages.items():
        for name in names:
            if name not in robot.axes:
                yield Problem(
                    f"robot.stages.{stage}",
                    name,
                    message("engine", "must be one of {names}").fill(names=str(list(robot.axes))),
                )
            if name in seen:
                yield Problem(
                    f"robot.stages.{stage}",
                    name,
                    message("engine", "is in stage {seen} already").fill(seen=seen[name]),
                )
            seen[name] = stage


def _couplings(robot: Robot) -> Iterator[Problem]:
    seen = set()
    for index, coupling in enumerate(robot.couplings):
        key = f"coupling[{index}].axes"
        pair = list(coupling.axes)
        for name in pair:
            if name not in robot.axes:
                yield Problem(
                    key,
                    name,
                    message("engine", "must be one of {names}").fill(names=str(list(robot.axes))),
                )
                return
            if robot.axes[name].static:
                yield Problem(
                    key, name, marked("engine", "a static axis has no dynamics to couple")
                )
        if pair[0] == pair[1]:
            yield Problem(key, pair, marked("engine", "must name two different axes"))
        if (coupling.matrix, frozenset(pair)) in seen:
            yield Problem(
                key,
                pair,
                message("engine", "couples these axes in {matrix} a second time").fill(
                    matrix=coupling.matrix
                ),
            )
        seen.add((coupling.matrix, frozenset(pair)))


def _plate(robot: Robot) -> Iterator[Problem]:
    for key, value, bound in impossible(robot.plate):
        yield Problem(f"plate.{key}", value, bound)


def _definiteness(robot: Robot) -> Iterator[Problem]:
    names, mass, damping, stiffness = inertia_matrices(robot)
    if not names:
        return
    for matrix, letter, strict in (
        (mass, "M", True),
        (damping, "D", False),
        (stiffness, "C", False),
    ):
        scale = 1.0 / np.sqrt(np.where(np.diag(matrix) > 0, np.diag(matrix), 1.0))
        smallest = float(np.linalg.eigvalsh(matrix * np.outer(scale, scale))[0])
        if smallest < (1e-9 if strict else -1e-9):
            values = [c.value for c in robot.couplings if c.matrix == letter]
            word = "definite" if strict else "semi-definite"
            yield Problem(
                "coupling",
                values,
                message(
                    "engine", "{letter} must be positive {word}; make the coupling smaller"
                ).fill(letter=letter, word=word),
            )


_AXIS_CHECKS: tuple[Callable[[Axis], Iterator[Problem]], ...] = (_ranges, _dynamics, _drive)
_ROBOT_CHECKS: tuple[Callable[[Robot], Iterator[Problem]], ...] = (
    _stages,
    _couplings,
    _plate,
    _definiteness,
)
