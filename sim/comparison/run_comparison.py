"""Comparison of two runs of a machine: tap by tap, and along the path of the tip."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.comparison.comparison import COMPARED_TAPS, ModelComparison, compare
from rotemina.sim.errors import ChainError, InputError
from rotemina.sim.kinematics import JOINTS, KinematicChain, compute_tip_position
from rotemina.sim.plant import ModelResponse
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import Robot


@dataclass(frozen=True, slots=True, eq=False)
class RunComparison:
    """A run compared with another run, from the first row of each to the end of the shorter one.

    Attributes
    ----------
    comparison : ModelComparison
        The other run takes the place of the model: ``real − model`` is run − other, and the delay
        is the time by which the run lags the other one.
    path_rms, path_peak : float or None
        Rms and maximum distance, m, between the tips at the same time. None unless all joints of
        both tips were measured.
    """

    comparison: ModelComparison
    path_rms: float | None
    path_peak: float | None

    def as_json(self) -> dict[str, Any]:
        """Return the comparison as a JSON object, with the figures of the path in m."""
        path = {"path_rms": self.path_rms, "path_peak": self.path_peak}
        return {**self.comparison.as_json(), **path}


def compare_runs(robot: Robot, run: Record, other: Record) -> RunComparison:
    """Compare every tap that was measured in both runs; the other run is interpolated.

    Raises
    ------
    InputError
        If the runs have no common tap, their units differ, or nothing moves.
    """
    common_channels = [c for c in run.columns if c.tap in COMPARED_TAPS and other.has(*c)]
    if not common_channels:
        raise InputError(
            "the runs have no measured channel in common: {measured} and {measured_other}",
            measured=_list_measured_channels(run),
            measured_other=_list_measured_channels(other),
        )
    for axis in dict.fromkeys(channel.axis for channel in common_channels):
        if run.units[axis] != other.units[axis]:
            raise InputError(
                "axis {axis} is in {unit} in one run and in {other_unit} in the other; "
                "the runs are from different machines",
                axis=axis,
                unit=run.units[axis],
                other_unit=other.units[axis],
            )
    compared_channels = [c for c in run.columns if c in common_channels or c.tap is Tap.CMD]
    rows = slice(0, int(np.searchsorted(_compute_elapsed_s(run), other.duration_s, side="right")))
    shortened_run = Record.from_signals(
        run.time_s[rows],
        {(c.axis, c.tap): run.signal(*c)[rows] for c in compared_channels},
        run.units,
        run.metadata,
    )
    signals = {
        (c.axis, c.tap): np.interp(
            _compute_elapsed_s(shortened_run), _compute_elapsed_s(other), other.signal(*c)
        )
        for c in common_channels
    }
    response = ModelResponse(shortened_run.time_s, signals, {})
    distances = _compute_tip_distances(robot, shortened_run, signals)
    return RunComparison(
        compare(robot, shortened_run, response=response),
        None if distances is None else float(np.sqrt(np.mean(distances**2))),
        None if distances is None else float(distances.max()),
    )


def _compute_tip_distances(
    robot: Robot, run: Record, other: dict[tuple[str, Tap], FloatArray]
) -> FloatArray | None:
    """Return the distance (n,), m, between the tips, or None if a joint was not measured."""
    try:
        chain = KinematicChain.of(robot)
    except ChainError:
        return None
    if any((joint, Tap.MEAS) not in other for joint in JOINTS):
        return None
    tip = compute_tip_position(
        chain, np.column_stack([run.signal(joint_name, Tap.MEAS) for joint_name in JOINTS])
    )
    other_tip = compute_tip_position(
        chain, np.column_stack([other[joint_name, Tap.MEAS] for joint_name in JOINTS])
    )
    return np.asarray(np.linalg.norm(tip - other_tip, axis=1), dtype=np.float64)


def _compute_elapsed_s(record: Record) -> FloatArray:
    return np.asarray(record.time_s - record.time_s[0], dtype=np.float64)


def _list_measured_channels(record: Record) -> str:
    return ", ".join(str(c) for c in record.columns if c.tap in COMPARED_TAPS) or "none"
