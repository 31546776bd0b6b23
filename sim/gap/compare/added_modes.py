"""A machine that rings in many modes: more than a few causes, added one by one, could hold.

Its modes are found all at once by vector fitting of spectra, those of every axis that drives them
together. That takes records of steady periodic motion, whose spectra do not leak. Modes driven by
the axis' own input are a ``flexible_mode``, those driven by another axis' a
``cross_coupling``.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import expm

from rotemina.sim.arrays import (
    BoolArray,
    ComplexArray,
    FloatArray,
)
from rotemina.sim.effects import MODE_COUNT
from rotemina.sim.gap.compare.explanations import Explanation, mean_squares
from rotemina.sim.gap.fit import Evidence, Fit, by_spectra
from rotemina.sim.gap.limits import FAR_OFF_POWER, MIN_CAUSE_SHARE
from rotemina.sim.gap.result import Account
from rotemina.sim.identification import (
    InputOutputSpectra,
    fit_poles,
    pole_contributions,
    reduce_poles,
    relocate_poles,
)
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import AxisEffect, ForceAxis

_SOUGHT = 24  # modes, of which the best are kept
_RINGING = 0.2  # damping ratio below which a mode rings
_FEW = 4  # modes that three causes and the model's own make
_AT_LEAST = 6  # modes that ring, each closing more than a trifle
_TRIFLE = 0.001  # of the gap's power
_LEFT = 0.1  # of the gap's power, that they may leave
_SLOWEST = 0.01  # of a record's first line: what is slower is a constant
_DAMPED = 1e-5  # damping ratio below which a mode is a line of noise
_EXCITED = 1e-6  # of the strongest line's power, from which a line is driven


@dataclass(frozen=True, eq=False)
class _Axis:
    """Spectra of an axis' unexplained motion, record by record, and its possible sources."""

    evidence: Evidence
    sources: tuple[str, ...]
    step_s: float
    z: ComplexArray
    inputs: ComplexArray
    output: ComplexArray
    own: AxisEffect  # of modes that the axis' own input drives, and that of another axis
    other: AxisEffect

    @property
    def slowest(self) -> float:
        """The modulus of a pole that rings for about a period of the record."""
        return float(1.0 - np.pi / _period(self.evidence.observations[0].record))

    def spectra(self, records: Sequence[int], sources: Sequence[str]) -> InputOutputSpectra:
        """Return the spectra of some records, with some of the sources."""
        own = list(records)
        whole = InputOutputSpectra.from_records(self.z, self.inputs[own], self.output[own])
        return whole.select_inputs([self.sources.index(name) for name in sources])


def many_modes(evidence: Evidence, account: Account) -> Explanation | None:
    """Explain a gap by many modes if they cause it; otherwise return None.

    Sources that close less than their share are left out.
    """
    axis = _gathered(evidence)
    if axis is None:
        return None
    account.tell("fitting", axis.own.id)
    records = range(len(axis.output))
    sources = list(axis.sources)
    whole = axis.spectra(records, sources)
    raw = float(np.sum(np.abs(axis.output) ** 2))
    poles = fit_poles(whole, _SOUGHT, axis.slowest, max_poles=MODE_COUNT)
    left, grown = pole_contributions(whole, poles)
    ringing = grown[_damping(poles) < _RINGING]
    if left > _LEFT * raw or np.sum(ringing > _TRIFLE * raw) < _AT_LEAST:
        return None
    few = reduce_poles(whole, poles, axis.slowest, max_poles=_FEW)
    if pole_contributions(whole, few)[0] - left < MIN_CAUSE_SHARE * raw:
        return None
    for name in axis.sources:
        others = [one for one in sources if one != name]
        if others and _left(axis, poles, records, others) - left < MIN_CAUSE_SHARE * raw:
            sources = others
    return _explained(axis, poles, sources)


def _gathered(evidence: Evidence) -> _Axis | None:
    """Return the spectra of an axis, or None where the records allow none."""
    observations = evidence.observations
    first = observations[0].record
    if any(_period(one.record) != _period(first) for one in observations) or _period(first) == 0:
        return None
    step_s = float(first.time_s[1] - first.time_s[0])
    if any(abs(o.record.time_s[1] - o.record.time_s[0] - step_s) > 1e-9 for o in observations):
        return None
    if any(o.floor.keys() != observations[0].floor.keys() for o in observations):
        return None
    if (
        float(np.mean(evidence.residual() ** 2)) < FAR_OFF_POWER
        or Tap.MEAS not in observations[0].real
    ):
        return None
    names = [name for name in evidence.robot.axes if _drives(evidence, name)]
    if evidence.axis not in names or isinstance(evidence.robot.axes[evidence.axis], ForceAxis):
        return None
    inputs = np.stack(
        [
            [_spectrum(one.record, _input(evidence, one.record, name)) for name in names]
            for one in observations
        ]
    )
    answers = evidence.response()
    output = np.stack(
        [
            _spectrum(one.record, one.real[Tap.MEAS] - answer[Tap.MEAS])
            for one, answer in zip(observations, answers, strict=True)
        ]
    )
    power = (np.abs(inputs) ** 2).sum(axis=(0, 1))
    power[0] = 0.0
    driven = power > _EXCITED * power.max()
    if driven.sum() < 2 * _SOUGHT * (len(names) + 1):
        return None
    angle = 2.0 * np.pi * np.arange(len(power)) / _period(first)
    z = np.exp(1j * angle)[driven]
    own = (evidence.axis, *(name for name in names if name != evidence.axis))
    order = [names.index(name) for name in own]
    modes, leaking = (_asked(evidence.axis, coupled=one) for one in (False, True))
    if modes is None or leaking is None:
        return None
    seen = inputs[:, order][..., driven], output[:, driven]
    return _Axis(evidence, own, step_s, z, *seen, modes, leaking)


def _asked(axis: str, *, coupled: bool) -> AxisEffect | None:
    """Return the effect of many modes on an axis, if one is installed."""
    found = by_spectra(coupled=coupled)
    return found and AxisEffect(axis=axis, id=found[0].id, formulation=found[1].name)


def _period(record: Record) -> int:
    """Return the rows of a record's period, 0 where it has none."""
    return int(record.period_samples or 0) if record.history == "periodic" else 0


def _drives(evidence: Evidence, name: str) -> bool:
    """Tell whether every record says what drives an axis."""
    records = [one.record for one in evidence.observations]
    by = Tap.U if isinstance(evidence.robot.axes[name], ForceAxis) else Tap.CMD
    return all(record.has(name, by) and not record.closed_loop for record in records)


def _input(evidence: Evidence, record: Record, name: str) -> FloatArray:
    """Return the input (n,) of an axis in its unit of position; V for a force-driven axis."""
    if isinstance(evidence.robot.axes[name], ForceAxis):
        return record.signal(name, Tap.U)
    return record.signal(name, Tap.CMD)


def _spectrum(record: Record, signal: FloatArray) -> ComplexArray:
    """Return the spectrum (lines,) of the mean of a record's whole periods."""
    period = _period(record)
    whole = len(signal) // period
    mean = signal[: whole * period].reshape(whole, period).mean(axis=0)
    return np.asarray(np.fft.rfft(mean))


def _damping(poles: ComplexArray) -> FloatArray:
    return np.asarray(-np.cos(np.angle(np.log(poles))))


def _left(
    axis: _Axis, poles: ComplexArray, records: Sequence[int], sources: Sequence[str]
) -> float:
    spectra = axis.spectra(records, sources)
    return pole_contributions(spectra, relocate_poles(spectra, poles, axis.slowest))[0]


def _explained(axis: _Axis, poles: ComplexArray, sources: Sequence[str]) -> Explanation:
    """Return the explanation by modes that some sources drive, with the unseen remainder.

    A single record leaves no unseen data: its remainder is raised to the expected one of a fit with
    as many parameters on another record (Akaike, Ann. Inst. Statist. Math. 22 (1970) 203-217).
    """
    evidence = axis.evidence
    records = range(len(axis.output))
    effects = _effects(axis, poles, records, sources)
    residual = evidence.residual(effects)
    fitted = Fit(effects, (), np.zeros(0), residual, np.zeros((len(residual), 0)))
    held_out = residual.copy()
    for number in records if len(records) > 1 else ():
        others = [one for one in records if one != number]
        spectra = axis.spectra(others, sources)
        own = relocate_poles(spectra, poles, axis.slowest)
        effects = _effects(axis, own, others, sources)
        held_out[_rows(evidence, number)] = evidence.residual(effects, [number])
    if len(records) == 1:
        told, free = 2 * axis.output.size, 2 * len(poles) * (len(sources) + 1)
        held_out *= np.sqrt((told + free) / (told - free))
    return Explanation(fitted.effects, fitted, held_out, mean_squares(evidence, held_out))


def _rows(evidence: Evidence, record: int) -> BoolArray:
    parts = evidence.parts
    rows = np.zeros(parts[-1].rows.stop, dtype=np.bool_)
    for part in parts:
        if part.record == record:
            rows[part.rows] = True
    return rows


def _effects(
    axis: _Axis, poles: ComplexArray, records: Sequence[int], sources: Sequence[str]
) -> tuple[AxisEffect, ...]:
    """Return the modes as effects of the axis, with the shares that suit these records best."""
    spectra = axis.spectra(records, sources)
    slowest = 2.0 * np.pi * _SLOWEST / (axis.step_s * _period(axis.evidence.observations[0].record))
    rate = np.maximum(np.abs(np.log(poles)) / axis.step_s, slowest)
    damping = np.maximum(_damping(poles), _DAMPED)
    answers = np.concatenate(
        [_answers(spectra.z, *mode, axis.step_s) for mode in zip(rate, damping, strict=True)]
    ).T
    design = np.vstack([np.hstack([answers * x[:, None] for x in own]) for own in spectra.inputs])
    whole = np.concatenate([design.real, design.imag])
    output = spectra.output.ravel()
    size = np.linalg.norm(whole, axis=0)
    shares = np.linalg.lstsq(whole / size, np.concatenate([output.real, output.imag]))[0] / size
    asked = []
    for name, own in zip(sources, shares.reshape(len(sources), -1, 2), strict=True):
        numbers = _numbers(rate / (2.0 * np.pi), damping, own)
        driven_by_own = name == axis.evidence.axis
        one = axis.own if driven_by_own else replace(axis.other, from_axis=name)
        asked.append(replace(one, parameters=numbers))
    return tuple(asked)


def _numbers(frequency: FloatArray, damping: FloatArray, shares: FloatArray) -> dict[str, float]:
    numbers: dict[str, float] = {}
    for k in range(len(frequency)):
        numbers[f"frequency_{k + 1}"] = float(frequency[k])
        numbers[f"damping_ratio_{k + 1}"] = float(damping[k])
        numbers[f"share_{k + 1}"] = float(shares[k, 0])
        numbers[f"speed_share_{k + 1}"] = float(shares[k, 1])
    for k in range(len(frequency), MODE_COUNT):
        numbers[f"share_{k + 1}"] = 0.0
    return numbers


def _answers(z: ComplexArray, rate: float, damping: float, step_s: float) -> ComplexArray:
    """Return deflection and speed over ω (2, lines) that a mode answers to an input held by steps.

    ``x(n+1) = Φ x(n) + Γ u(n)`` in closed form for ``ẋ = [[0, ω], [−ω, −2ζω]] x + [0, ω] u``.
    """
    a = rate * np.array([[0.0, 1.0], [-1.0, -2.0 * damping]])
    phi = expm(a * step_s)
    gamma = np.linalg.solve(a, (phi - np.eye(2)) @ np.array([0.0, rate]))
    # Cramer's rule for (z − Φ) x = Γ.
    determinant = (z - phi[0, 0]) * (z - phi[1, 1]) - phi[0, 1] * phi[1, 0]
    first = ((z - phi[1, 1]) * gamma[0] + phi[0, 1] * gamma[1]) / determinant
    second = ((z - phi[0, 0]) * gamma[1] + phi[1, 0] * gamma[0]) / determinant
    return np.stack([first, second])
