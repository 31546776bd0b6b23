"""Comparison of two runs of a machine: tap by tap, and along the tip's path."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.comparison import COMPARED_TAPS, Comparison, compare
from rotemina.sim.errors import InputError
from rotemina.sim.kinematics.chain import JOINTS, Chain, ChainError
from rotemina.sim.kinematics.forward import tip_position
from rotemina.sim.messages import message
from rotemina.sim.plant.response import Response
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.model import Robot


@dataclass(frozen=True, slots=True, eq=False)
class RunComparison:
    """A run against another one, from the first row of each, as long as both last.

    ``comparison`` has the other run in the model's place: ``real − model`` is run − other, and the
    delay is how much later the run comes. ``path_rms`` and ``path_peak`` are of the distance
    between both tips at the same time, m; None where not all joints of a tip were measured.
    """

    comparison: Comparison
    path_rms: float | None
    path_peak: float | None

    def as_json(self) -> dict[str, Any]:
        """Return the comparison as a JSON object, with the path's figures in m."""
        path = {"path_rms": self.path_rms, "path_peak": self.path_peak}
        return {**self.comparison.as_json(), **path}


def compare_runs(robot: Robot, run: Record, other: Record) -> RunComparison:
    """Compare every tap that both runs have measured; the other one is interpolated in between.

    Raises
    ------
    InputError
        If no tap is common, a unit differs, or nothing moves while both last.
    """
    common = [c for c in run.columns if c.tap in COMPARED_TAPS and other.has(*c)]
    if not common:
        raise InputError(
            message(
                "engine",
                "the runs have no measured channel in common: {measured} and {measured_other}",
            ).fill(measured=_measured(run), measured_other=_measured(other))
        )
    for axis in dict.fromkeys(channel.axis for channel in common):
        if run.units[axis] != other.units[axis]:
            raise InputError(
                message(
                    "engine",
                    "axis {axis} is in {unit} in one run and in {other_unit} in the other; "
                    "the runs are from different machines",
                ).fill(axis=axis, unit=run.units[axis], other_unit=other.units[axis])
            )
    kept = [c for c in run.columns if c in common or c.tap is Tap.CMD]
    rows = slice(0, int(np.searchsorted(_since(run), other.duration_s, side="right")))
    shown = Record.from_signals(
        run.time_s[rows],
        {(c.axis, c.tap): run.signal(*c)[rows] for c in kept},
        run.units,
        run.metadata,
    )
    signals = {
        (c.axis, c.tap): np.interp(_since(shown), _since(other), other.signal(*c)) for c in common
    }
    answer = Response(shown.time_s, signals, {})
    apart = _tips_apart(robot, shown, signals)
    return RunComparison(
        compare(robot, shown, response=answer),
        None if apart is None else float(np.sqrt(np.mean(apart**2))),
        None if apart is None else float(apart.max()),
    )


def _tips_apart(
    robot: Robot, run: Record, other: dict[tuple[str, Tap], FloatArray]
) -> FloatArray | None:
    """Return the distance (n,), m, between both tips; None where a joint was not measured."""
    try:
        chain = Chain.of(robot)
    except ChainError:
        return None
    if any((joint, Tap.MEAS) not in other for joint in JOINTS):
        return None
    here = tip_position(chain, np.column_stack([run.signal(one, Tap.MEAS) for one in JOINTS]))
    there = tip_position(chain, np.column_stack([other[one, Tap.MEAS] for one in JOINTS]))
    return np.asarray(np.linalg.norm(here - there, axis=1), dtype=np.float64)


def _since(record: Record) -> FloatArray:
    return np.asarray(record.time_s - record.time_s[0], dtype=np.float64)


def _measured(record: Record) -> str:
    return ", ".join(str(c) for c in record.columns if c.tap in COMPARED_TAPS) or "none"
