"""A diagnosis with the gap traces and heat maps to be drawn. Does not use Qt."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

from rotemina.sim.gap.output import GapHeatmap, GapTrace, compute_traces, make_heatmap, unit_of
from rotemina.sim.gap.result import Diagnosis
from rotemina.sim.records import Record, Tap


@dataclass(frozen=True, slots=True, eq=False)
class DiagnosisAnswer:
    """Diagnosis with its records, and the gap traces and heat maps computed from both.

    Attributes
    ----------
    diagnosis : Diagnosis
    names : tuple of str
        The names of ``records``.
    records : tuple of Record
    traces : mapping axis -> traces
        The gap of each record and tap over time.
    heat_maps : mapping (axis, tap) -> heat map
        Taps for which no heat map can be drawn are missing.
    """

    diagnosis: Diagnosis
    names: tuple[str, ...]
    records: tuple[Record, ...]
    traces: Mapping[str, tuple[GapTrace, ...]]
    heat_maps: Mapping[tuple[str, Tap], GapHeatmap]

    @classmethod
    def from_diagnosis(
        cls, diagnosis: Diagnosis, names: Sequence[str], records: Sequence[Record]
    ) -> Self:
        """Compute the gap traces and heat maps. This takes a second or two.

        Raises
        ------
        PlantError, EffectError
            If the corrected model cannot be simulated.
        """
        traces_by_axis = {axis: compute_traces(diagnosis, axis, records) for axis in diagnosis.axes}
        heat_maps = {}
        for axis, axis_traces in traces_by_axis.items():
            for tap in dict.fromkeys(trace.tap for trace in axis_traces):
                heat_map = make_heatmap([trace for trace in axis_traces if trace.tap is tap])
                if heat_map is not None:
                    heat_maps[axis, tap] = heat_map
        return cls(diagnosis, tuple(names), tuple(records), traces_by_axis, heat_maps)

    def unit(self, axis: str, tap: Tap) -> str:
        """Return the SI unit of a tap."""
        return unit_of(axis, tap, self.records)

    @property
    def units(self) -> dict[str, str]:
        """SI units of all axes of the records and of the robot, by axis."""
        robot = self.diagnosis.robot
        robot_units = {name: unit for name in robot.axes if (unit := robot.unit(name))}
        record_units = {
            name: unit for record in self.records for name, unit in record.units.items()
        }
        return record_units | robot_units

    @property
    def first_axis(self) -> str:
        """Axis to show first: the axis of the first cause, or of the largest gap, or any axis."""
        axes = [cause.axis for cause in self.diagnosis.causes]
        # The places are sorted by the size of their gaps, the largest first.
        axes += [place.axis for place in self.diagnosis.places]
        return (axes + list(self.diagnosis.axes))[0]
