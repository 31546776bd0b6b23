"""How far an effect would follow by chance what no catalogue holds.

Every real machine also does something that nobody will name: a smooth function of place, speed and
recent activity, or a coloured force. An effect with a free shape bends to much of it, one with a
shape of its own hardly to any. Remainders drawn by chance tell how much of what an effect closes
this may be: a null distribution by simulation (Davison and Hinkley, Bootstrap Methods and their
Application, Cambridge 1997, ch. 4).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.compare.explanations import Explanation
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.location import apply_lag
from rotemina.sim.records import Tap

_DRAWS = 100
_OF_MOTION = 0.6  # of the draws; the others are forces
_POINTS = 2000  # of a record, between which a smooth remainder is straight
_WAVES = 16
_ACROSS = (4.0, 1.5, 1.0)  # rms phase of a wave, rad, over travel, pace and recent activity
_SPEED_S, _ACTIVITY_S = (0.01, 0.1), (0.3, 2.0)  # time constants
_CROSSING_S = (0.1, 0.4)  # time for the travel, at the pace that counts
_COLOUR_HZ = (0.3, 6.0), (6.0, 20.0)  # corners of a force
_GRID_S = 0.01  # between the kicks of a force
_MOST_KICKS = 20_000

Motions = list[tuple[FloatArray, FloatArray]]  # of each record: times, s, and places, m or rad


@dataclass(frozen=True, eq=False)
class RandomRemainders:
    """Remainders drawn by chance on an axis, the same ones for the same records."""

    evidence: Evidence

    @cached_property
    def _drawn(self) -> list[Motions]:
        """The draws: times (n,) and displacements (n,) for each record."""
        rng = np.random.default_rng(0)
        evidence = self.evidence
        motions = [_motion(evidence, number) for number in range(len(evidence.observations))]
        low, high = evidence.reach
        travel = high - low or evidence.robot.axes[evidence.axis].span  # where it was only held
        of_motion = round(_OF_MOTION * _DRAWS)
        found = [_of_motion(motions, travel, rng) for _ in range(of_motion)]
        return found + [_of_time(motions, rng) for _ in range(_DRAWS - of_motion)]

    def p_value(self, best: Explanation, cause: tuple[str, str | None], share: float) -> float:
        """Return the part of the draws of which a cause follows more than a share.

        What the other causes follow is taken off before. All follow by small changes about what
        was fitted: along the columns of its jacobian (rows, parameters).
        """
        fit = best.fit
        mine = [fit.effects[free.effect] for free in fit.free]
        own = np.array([(one.id, one.from_axis) == cause for one in mine], dtype=np.bool_)
        if not own.any():
            return 0.0
        others = np.linalg.qr(fit.jacobian[:, ~own])[0]
        apart = fit.jacobian[:, own]
        directions = np.linalg.qr(apart - others @ (others.T @ apart))[0]
        followed = 0
        for one in self._drawn:
            remainder = self._seen(one)
            remainder -= others @ (others.T @ remainder)
            along = directions.T @ remainder
            followed += bool(along @ along > share * (remainder @ remainder))
        return followed / _DRAWS

    def _seen(self, drawn: Motions) -> FloatArray:
        """Return a draw (rows,) as the residual has it: in the motion, or else in the effort."""
        evidence = self.evidence
        moved = any(part.tap is not Tap.U for part in evidence.parts)
        seen = np.zeros(evidence.parts[-1].rows.stop)
        for part in evidence.parts:
            if part.tap is not Tap.U or not moved:
                own = evidence.observations[part.record]
                signal = np.interp(own.record.time_s, *drawn[part.record]) / own.floor[part.tap]
                seen[part.rows] = evidence.without_nuisance(part.record, part.tap, signal)
        return seen


def _motion(evidence: Evidence, number: int) -> tuple[FloatArray, FloatArray]:
    """Return times (n,) and places (n,), m or rad, of some points of a record."""
    record = evidence.observations[number].record
    (answer,) = evidence.response((), [number])
    moved = answer.get(Tap.MEAS, answer.get(Tap.REF, record.signal(evidence.axis, Tap.CMD)))
    time_s = np.linspace(record.time_s[0], record.time_s[-1], min(len(record.time_s), _POINTS))
    return time_s, np.interp(time_s, record.time_s, moved)


def _of_motion(motions: Motions, travel: float, rng: np.random.Generator) -> Motions:
    """Draw a smooth function of place, filtered speed and recent activity."""
    speed_s, active_s = rng.uniform(*_SPEED_S), rng.uniform(*_ACTIVITY_S)
    pace = travel / rng.uniform(*_CROSSING_S)
    waves = rng.normal(0.0, _ACROSS, (_WAVES, 3))
    phases = rng.uniform(0.0, 2.0 * np.pi, (_WAVES, 1))
    found = []
    for time_s, place in motions:
        step_s = (time_s[-1] - time_s[0]) / (len(time_s) - 1)
        speed = apply_lag(np.gradient(place, step_s), speed_s / step_s)
        active = apply_lag(np.abs(speed), active_s / step_s)
        seen = np.stack([place / travel, speed / pace, active / pace])
        found.append((time_s, np.cos(waves @ seen + phases).sum(axis=0)))
    return found


def _of_time(motions: Motions, rng: np.random.Generator) -> Motions:
    """Draw a coloured force that is the same in every record."""
    longest_s = max(float(time_s[-1] - time_s[0]) for time_s, _ in motions)
    step_s = max(_GRID_S, longest_s / _MOST_KICKS)
    force = rng.normal(size=int(longest_s / step_s) + 2)
    for hz in _COLOUR_HZ:
        force = apply_lag(force, 1.0 / (2.0 * np.pi * rng.uniform(*hz) * step_s))
    grid_s = step_s * np.arange(len(force))
    return [(time_s, np.interp(time_s - time_s[0], grid_s, force)) for time_s, _ in motions]
