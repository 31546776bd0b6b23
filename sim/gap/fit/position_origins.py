"""The origin of position of each record: a counter restarts, a screw does not.

Effects locked to position have one amplitude in all records, and one phase if the records share
their origin. Records with the same line over position, but phases that no period reconciles, have
different origins.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import scipy

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.effects import AxisProperties
from rotemina.sim.gap.fit.effect_catalogue import catalogue
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.fit.strongest_line import line_over
from rotemina.sim.messages import Message, message
from rotemina.sim.records import Tap

_MOSTLY = 0.5  # of a record's gap, that its line makes
_AGREE = 0.9  # of what lines of any phase explain, that lines of one phase do
_ALIKE = 2.0  # times, by which the line's amplitudes differ at most
_PERIODS = 3.0  # that a record goes over
_FINER = 4.0  # rates within the width of a line
_AROUND = 1.5  # widths of a line, within which its rate is looked for
_SHARP = 1e-5  # widths of a line, to which its rate is found
_MOST_RATES = 1000
_MOST_ROWS = 1500  # of a record
_NOTHING = 0.03  # of a period, by which origins do not differ


class _Line(NamedTuple):
    """A record's gap (n,) over its place (n,), m or rad, without their means."""

    record: int
    place: FloatArray
    gap: FloatArray

    def wave(self, rate: float) -> tuple[complex, float]:
        """Return A of ``Re(A exp(2πi rate x))`` in the gap, and the power it explains."""
        angle = 2.0 * np.pi * rate * self.place
        design = np.stack([np.ones(len(angle)), np.cos(angle), -np.sin(angle)], axis=1)
        found = np.linalg.lstsq(design, self.gap)[0]
        left = self.gap - design @ found
        return complex(found[1], found[2]), self.power - float(left @ left)

    @property
    def power(self) -> float:
        """The sum of squares of the gap."""
        return float(self.gap @ self.gap)


def with_origins(evidence: Evidence) -> Evidence:
    """Return evidence whose records count place from their own origins, if these differ."""
    bounds = _periods(evidence)
    if bounds is None or len(evidence.observations) < 2:
        return evidence
    found = (_origins(_seen(evidence, tap), bounds) for tap in (Tap.REF, Tap.MEAS))
    origins = next((own for own in found if any(own.values())), None)
    if origins is None:
        return evidence
    return evidence.with_observations(
        [
            replace(one, origin=origins.get(number, 0.0))
            for number, one in enumerate(evidence.observations)
        ]
    )


def origin_remarks(evidence: Evidence) -> tuple[Message, ...]:
    """Return a sentence where records count their place from different origins."""
    count = sum(one.origin != 0.0 for one in evidence.observations)
    if count == 0:
        return ()
    said = message(
        "gap",
        "{n} of {all} records use another origin of position: effects locked to the"
        " position have the same period in all records, but another phase in these.",
    )
    return (said.fill(n=str(count), all=str(len(evidence.observations))),)


def _periods(evidence: Evidence) -> tuple[float, float] | None:
    """Return the bounds of periods that may be locked to position; None without any."""
    facts = AxisProperties.of(evidence.robot.axes[evidence.axis])
    found = []
    for effect in catalogue():
        if effect.identification.moved is not None and facts.kind in effect.kinds:
            parameter = effect.formulations[0].find_parameter("period")
            if parameter is not None:
                found.append(parameter.bounds(facts))
    return (min(low for low, _ in found), max(high for _, high in found)) if found else None


def _seen(evidence: Evidence, tap: Tap) -> list[_Line]:
    """Return the remainder of a tap in each record that has it."""
    seen = []
    whole = zip(evidence.response(), evidence.gaps(), strict=True)
    for number, (answer, gap) in enumerate(whole):
        if tap in gap:
            stride = max(len(gap[tap]) // _MOST_ROWS, 1)
            seen.append(_Line(number, answer[tap][::stride], gap[tap][::stride]))
    return seen


def _origins(seen: Sequence[_Line], bounds: tuple[float, float]) -> dict[int, float]:
    """Return by record where it begins to count its place, m or rad; none where all agree."""
    widest = max(seen, key=lambda one: float(np.ptp(one.place)), default=None)
    begun = None if widest is None else line_over(widest.place, widest.gap, bounds)
    if widest is None or begun is None or len(seen) < 2:
        return {}
    reach = float(np.ptp(widest.place))
    rate = _likeliest(seen, 1.0 / begun, reach)
    waves = [one.wave(rate) for one in seen]
    own = np.array([wave for wave, _ in waves])
    explained = np.array([power for _, power in waves])
    period = 1.0 / rate
    if not _is_one_line(seen, own, explained, period):
        return {}
    if _together(seen, rate, reach) >= _AGREE * explained.sum():
        return {}
    turns = np.angle(own) / (2.0 * np.pi)
    apart = turns[:, None] - turns[None, :]
    apart -= np.rint(apart)
    first = int(np.argmin(np.abs(apart).sum(axis=0)))  # that most others are near
    return {
        one.record: float(part * period) if abs(part) > _NOTHING else 0.0
        for one, part in zip(seen, apart[:, first], strict=True)
    }


def _likeliest(seen: Sequence[_Line], near: float, reach: float) -> float:
    """Return the rate near another one that explains most, at any phase in each record."""

    def left(rate: float) -> float:
        return -sum(one.wave(rate)[1] for one in seen)

    tried = near + np.arange(-_AROUND, _AROUND + 0.5 / _FINER, 1.0 / _FINER) / reach
    best = float(min(tried, key=left))
    about = (best - 1.0 / _FINER / reach, best + 1.0 / _FINER / reach)
    found = scipy.optimize.minimize_scalar(
        left, bounds=about, method="bounded", options={"xatol": _SHARP / reach}
    )
    return float(found.x)


def _is_one_line(
    seen: Sequence[_Line], waves: ComplexArray, explained: FloatArray, period: float
) -> bool:
    """Tell whether a line makes most of every record's gap, as large in all."""
    sizes = np.abs(waves)
    return bool(
        all(float(np.ptp(one.place)) > _PERIODS * period for one in seen)
        and np.all(explained > _MOSTLY * np.array([one.power for one in seen]))
        and sizes.max() < _ALIKE * sizes.min()
    )


def _together(seen: Sequence[_Line], rate: float, reach: float) -> float:
    """Return the most that a wave of one phase over all records explains.

    The search covers rates around that of the lines, on a grid finer than the resolution of the
    span.
    """
    whole = _Line(
        0, np.concatenate([one.place for one in seen]), np.concatenate([one.gap for one in seen])
    )
    count = min(int(2 * _AROUND * _FINER * float(np.ptp(whole.place)) / reach), _MOST_RATES)
    tried = rate + np.linspace(-_AROUND, _AROUND, count + 1) / reach
    return max(whole.wave(float(one))[1] for one in tried)
