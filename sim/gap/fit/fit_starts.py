"""Starting points of a fit: each effect derives them from the records and the remainder."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from rotemina.sim.arrays import FloatArray
from rotemina.sim.effects import (
    AttachedEffect,
    AxisProperties,
    AxisRecord,
    Interval,
    RecordCoverage,
    Values,
)
from rotemina.sim.gap.fit.effect_catalogue import is_whole_own
from rotemina.sim.gap.fit.evidence import Evidence, Signals
from rotemina.sim.gap.fit.output_error import Fit, tolerance
from rotemina.sim.gap.fit.quantization_grid import likeliest_grid
from rotemina.sim.gap.fit.strongest_line import strongest_frequency, strongest_periods
from rotemina.sim.records import Tap
from rotemina.sim.robot import AxisEffect


def starts(evidence: Evidence, fitted: Fit, candidate: AxisEffect) -> tuple[AxisEffect, ...]:
    """Return the candidate with starting parameters for its fit.

    ``fitted`` is the present explanation; the candidate is to explain its remainder.
    """
    given, attached = candidate.parameters, AttachedEffect.of(evidence.robot, candidate)
    begin = attached.effect.identification.starts
    return tuple(
        replace(candidate, parameters={**given, **attached.clip_values(values)})
        for values in begin(EvidenceView(evidence, fitted, attached))
    )


@dataclass(frozen=True, eq=False)
class EvidenceView:
    """Evidence and a fit, as effects may access them."""

    evidence: Evidence
    fitted: Fit
    attached: AttachedEffect

    @property
    def facts(self) -> AxisProperties:
        """The axis."""
        return self.attached.facts

    @cached_property
    def values(self) -> Values:
        """All parameters, SI."""
        return self.attached.values

    @property
    def starts_from_other_fit(self) -> bool:
        """Whether the parameters are those of another formulation as fitted."""
        return bool(self.attached.entry.parameters)

    @cached_property
    def extent(self) -> RecordCoverage:
        """What the records cover."""
        return self.evidence.extent

    @cached_property
    def records(self) -> Sequence[AxisRecord]:
        """The records."""
        source, left = self.attached.entry.from_axis, self._by_tap(self.fitted.residual)
        return [
            AxisRecord(
                time_s=one.record.time_s,
                command=one.record.signal(self.evidence.axis, Tap.CMD),
                source=one.record.signal(source, Tap.CMD)
                if source is not None and one.record.has(source, Tap.CMD)
                else None,
                real=one.real,
                floor=one.floor,
                remainder=own,
            )
            for one, own in zip(self.evidence.observations, left, strict=True)
        ]

    @cached_property
    def answers(self) -> Sequence[Signals]:
        """What the model says of each record (n,) so far, SI."""
        return self.evidence.response(self.fitted.effects)

    @cached_property
    def untuned(self) -> tuple[Sequence[Signals], Sequence[Signals]]:
        """Answers and remainders, by record, with the model's original own parameters."""
        causes = [one for one in self.fitted.effects if not is_whole_own(one.id)]
        return self.evidence.response(causes), self._by_tap(self.evidence.residual(causes))

    def bounds(self, name: str) -> Interval:
        """Return the bounds of a parameter on this axis, SI."""
        parameter = self.attached.formulation.find_parameter(name)
        assert parameter is not None
        return parameter.bounds(self.facts)

    def domain(self, name: str) -> Interval:
        """Return how far a fit to these records may take a parameter, SI."""
        parameter = self.attached.formulation.find_parameter(name)
        assert parameter is not None
        return tolerance(self.attached, parameter, self.extent)

    def periods(self, bounds: Interval) -> Sequence[float]:
        """Return periods over position of the strongest lines of the remainder, m or rad."""
        return strongest_periods(self.evidence, self.fitted, bounds)

    def frequency(self, bounds: Interval) -> float | None:
        """Return the frequency of the strongest line over time of the remainder, Hz."""
        return strongest_frequency(self.evidence, self.fitted.residual, bounds)

    def grid(
        self, bounds: Interval, origin: float, gain: float, *, at_input: bool
    ) -> Values | None:
        """Return ``step`` and ``shift`` of the teeth in the remainder, if there are any."""
        return likeliest_grid(
            self.evidence,
            self.fitted,
            self.attached.entry,
            bounds,
            origin,
            gain,
            at_input=at_input,
        )

    def _by_tap(self, residual: FloatArray) -> list[dict[Tap, FloatArray]]:
        found: list[dict[Tap, FloatArray]] = [{} for _ in self.evidence.observations]
        for part in self.evidence.parts:
            found[part.record][part.tap] = residual[part.rows]
        return found
