"""A diagnosis with everything that is drawn of it. Free of Qt."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

from rotemina.sim.gap.diagnosis import Diagnosis
from rotemina.sim.gap.output.report.heat import Heat, heat
from rotemina.sim.gap.output.report.quantities import unit_of
from rotemina.sim.gap.output.report.traces import Trace, traces
from rotemina.sim.records.record import Record, Tap


@dataclass(frozen=True, slots=True, eq=False)
class Answer:
    """A diagnosis, the records that it is about, and signals and heat maps worked out from both.

    ``names`` and ``records`` go together. ``heats`` lacks taps of which no map can be drawn.
    """

    diagnosis: Diagnosis
    names: tuple[str, ...]
    records: tuple[Record, ...]
    traces: Mapping[str, tuple[Trace, ...]]
    heats: Mapping[tuple[str, Tap], Heat]

    @classmethod
    def of(cls, diagnosis: Diagnosis, names: Sequence[str], records: Sequence[Record]) -> Self:
        """Work out what is drawn; this takes a second or two.

        Raises
        ------
        PlantError, EffectError
            If the corrected model cannot be simulated.
        """
        found = {axis: traces(diagnosis, axis, records) for axis in diagnosis.axes}
        heats = {}
        for axis, own in found.items():
            for tap in dict.fromkeys(trace.tap for trace in own):
                drawn = heat([trace for trace in own if trace.tap is tap])
                if drawn is not None:
                    heats[axis, tap] = drawn
        return cls(diagnosis, tuple(names), tuple(records), found, heats)

    def unit(self, axis: str, tap: Tap) -> str:
        """Return the SI unit of a tap."""
        return unit_of(axis, tap, self.records)

    @property
    def units(self) -> dict[str, str]:
        """SI units of all axes that the records or the robot know."""
        robot = self.diagnosis.robot
        known = {name: unit for name in robot.axes if (unit := robot.unit(name))}
        seen = {name: unit for record in self.records for name, unit in record.units.items()}
        return seen | known

    @property
    def first_axis(self) -> str:
        """The axis with most to say."""
        said = [cause.axis for cause in self.diagnosis.causes]
        said += [place.axis for place in self.diagnosis.places]
        return (said + list(self.diagnosis.axes))[0]
