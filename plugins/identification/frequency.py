"""Frequency response of the pair: interval, coherence, and that of the nominal model."""

from typing import NamedTuple

import numpy as np

from rotemina.plugins.identification import mark, tr
from rotemina.plugins.identification.filled_template import FilledTemplate
from rotemina.plugins.identification.findings import Column, Curve, Findings, Picture, ratio_scale
from rotemina.plugins.identification.nominal_response import ABSENT, nominal_signals
from rotemina.plugins.identification.record_query import Question
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.identification.errors import TooShortError
from rotemina.sim.identification.experiment_signals import Signals
from rotemina.sim.identification.frequency_response import FrequencyResponse
from rotemina.sim.identification.multisine import periodic_response
from rotemina.sim.identification.resonance import Resonance, fit_resonance
from rotemina.sim.identification.welch import welch_response
from rotemina.sim.quantities import Scale, fixed, rounded, uncertain

INTERVAL = 0.95
WELCH, MULTISINE = "Welch", mark("multisine")
_COHERENT = 0.8
_PEAK = 2.0  # over the lowest line, from which a resonance is looked for
_BAND = (0.8, 1.25)  # about the peak, that the resonance is fitted to
_FEW_LINES = 8
_NARROW = 4  # lines, below which Welch's window flattens a resonance
_MISFIT = 0.1


class Estimate(NamedTuple):
    """A response (k lines) and how it was found."""

    method: str
    averages: str
    resolution_hz: float
    lines: FrequencyResponse

    @property
    def values(self) -> np.ndarray:
        """The complex response (k,)."""
        return self.lines.response[:, 0, 0]

    @property
    def radius(self) -> FloatArray:
        """The radius (k,) of the interval."""
        return self.lines.confidence_radius(INTERVAL)[:, 0, 0]


def frequency_findings(question: Question) -> Findings:
    """Estimate the frequency response: exactly for a periodic record, by Welch for any other."""
    signals = question.signals()
    measured = estimate(signals, question.averages)
    notices = []
    nominal: Estimate | None = None
    try:
        nominal = estimate(nominal_signals(question), question.averages)
    except (InputError, KeyError) as error:
        notices.append(FilledTemplate(ABSENT, reason=error))
    resonance: Resonance | None = None
    try:
        resonance = _resonance(question, measured)
    except InputError as error:
        notices.append(str(error))
    scale = ratio_scale(question, float(np.abs(measured.values).max()))
    return Findings(
        question,
        _pictures(question, scale, measured, nominal),
        (mark("figure"), mark("value")),
        _rows(scale, signals, measured, resonance),
        _columns(scale, measured, nominal),
        (*notices, *_doubts(measured, resonance)),
    )


def estimate(signals: Signals, averages: int) -> Estimate:
    """Estimate a response over whole periods where there are two, else over segments.

    Raises
    ------
    IdentificationError
    """
    period = signals.period_samples
    if period is not None and signals.count >= 2 * period:
        found = periodic_response(signals)
        averages = FilledTemplate(mark("{n} periods of {rows}"), n=found.periods, rows=period)
        return Estimate(MULTISINE, averages, signals.rate_hz / period, found.total)
    # Segments that overlap by half: 2n / (k + 1) samples make k of them.
    segment = 2 * signals.count // (averages + 1)
    if segment < _FEW_LINES:
        raise TooShortError(
            tr(
                "frequency response: {averages} averages of {n} samples give segments of "
                "{segment} samples; at least {least} are needed. Record longer or average "
                "less."
            ).format(n=signals.count, averages=averages, segment=segment, least=_FEW_LINES)
        )
    found = welch_response(signals, segment=segment)
    name = FilledTemplate(mark("{n} segments of {rows}"), n=averages, rows=segment)
    return Estimate(WELCH, name, signals.rate_hz / segment, found)


def _resonance(question: Question, measured: Estimate) -> Resonance | None:
    frequency_hz, size = measured.lines.frequency_hz, np.abs(measured.values)
    peak = int(np.argmax(size))
    if size[peak] < _PEAK * size[0] or not 0 < peak < len(size) - 1:
        return None
    # Half as many lines on either side as a fit of six numbers wants, however coarse they are.
    around = frequency_hz[max(peak - 4, 0)], frequency_hz[min(peak + 4, len(size) - 1)]
    band = (
        min(_BAND[0] * frequency_hz[peak], around[0]),
        max(_BAND[1] * frequency_hz[peak], around[1]),
    )
    return fit_resonance(
        frequency_hz,
        measured.values,
        band_hz=(float(band[0]), float(band[1])),
        deviation=measured.lines.deviation[:, 0, 0],
        held_at_hz=measured.lines.rate_hz if question.lag_samples else None,
    )


def _pictures(
    question: Question, scale: Scale, measured: Estimate, nominal: Estimate | None
) -> tuple[Picture, ...]:
    frequency_hz, size = measured.lines.frequency_hz, np.abs(measured.values)
    low, high = np.maximum(size - measured.radius, 0.01 * size), size + measured.radius
    magnitude = [
        Curve("", "quiet", frequency_hz, scale.per_si * low),
        Curve(f"{fixed(100 * INTERVAL, 0)} %", "quiet", frequency_hz, scale.per_si * high),
        Curve(mark("measured"), "real", frequency_hz, scale.per_si * size),
    ]
    phase = [Curve(mark("measured"), "real", frequency_hz, _phase_deg(measured))]
    if nominal is not None:
        at_hz = nominal.lines.frequency_hz
        beside = Curve(
            mark("model"), mark("model"), at_hz, scale.per_si * np.abs(nominal.values), width=3
        )
        magnitude.insert(2, beside)
        phase.insert(0, Curve(mark("model"), mark("model"), at_hz, _phase_deg(nominal), width=3))
    coherence = Curve(mark("measured"), "real", frequency_hz, measured.lines.coherence[:, 0])
    pair = f"{question.answer}/{question.drive}"
    bottom = mark("frequency [Hz]")
    return (
        Picture(f"|{pair}| [{scale.symbol or '1'}]", bottom, tuple(magnitude), True, True),
        Picture(mark("phase [°]"), bottom, tuple(phase), True),
        Picture(mark("coherence"), bottom, (coherence,), True, span=(0.0, 1.05)),
    )


def _phase_deg(found: Estimate) -> FloatArray:
    return np.degrees(found.lines.phase_rad[:, 0, 0])


def _rows(
    scale: Scale, signals: Signals, measured: Estimate, resonance: Resonance | None
) -> tuple[tuple[str, str], ...]:
    frequency_hz, size = measured.lines.frequency_hz, np.abs(measured.values)
    peak = int(np.argmax(size))
    rows = [
        (mark("gain, lowest line"), scale.text(size[0])),
        (mark("largest gain"), scale.text(size[peak])),
        (mark("at frequency"), f"{rounded(frequency_hz[peak], 5)} Hz"),
        (mark("median coherence"), fixed(np.median(measured.lines.coherence), 4)),
        (mark("estimator"), measured.method),
        (mark("averages"), measured.averages),
        (mark("lines"), str(len(size))),
        (mark("lowest line"), f"{rounded(frequency_hz[0], 5)} Hz"),
        (mark("highest line"), f"{rounded(frequency_hz[-1], 5)} Hz"),
        (mark("resolution"), f"{rounded(measured.resolution_hz)} Hz"),
        (mark("samples"), str(signals.count)),
        (mark("sampling rate"), f"{rounded(signals.rate_hz, 6)} Hz"),
    ]
    if resonance is None:
        return tuple(rows)
    known = uncertain(resonance.frequency_hz, resonance.frequency_deviation)
    frequency = f"{' ± '.join(known)} Hz"
    ratio = " ± ".join(uncertain(resonance.damping_ratio, resonance.damping_deviation))
    misfit = f"{rounded(100.0 * resonance.misfit, 3)} %"
    mode = [
        (mark("resonance"), frequency),
        (mark("damping ratio"), ratio),
        (mark("misfit of the mode"), misfit),
    ]
    return (*mode, *rows)


def _columns(scale: Scale, measured: Estimate, nominal: Estimate | None) -> tuple[Column, ...]:
    unit = scale.symbol or "1"
    frequency_hz = measured.lines.frequency_hz
    columns = {
        "frequency [Hz]": frequency_hz,
        f"magnitude [{unit}]": scale.per_si * np.abs(measured.values),
        "phase [deg]": _phase_deg(measured),
        f"radius of the {100 * INTERVAL:.0f} % interval [{unit}]": scale.per_si * measured.radius,
        "coherence [1]": measured.lines.coherence[:, 0],
    }
    # Where the model is driven by its own signal, its lines may be others: those stay out.
    if nominal is not None and np.array_equal(nominal.lines.frequency_hz, frequency_hz):
        columns[f"model magnitude [{unit}]"] = scale.per_si * np.abs(nominal.values)
        columns["model phase [deg]"] = _phase_deg(nominal)
    return tuple(Column(name, tuple(map(float, values))) for name, values in columns.items())


def _doubts(measured: Estimate, resonance: Resonance | None) -> list[str]:
    frequency_hz, coherence = measured.lines.frequency_hz, measured.lines.coherence[:, 0]
    doubts = []
    if len(frequency_hz) < _FEW_LINES:
        doubts.append(
            FilledTemplate(
                mark(
                    "The input excites only {n} lines, up to {highest:.4g} Hz ({wanted} lines "
                    "are needed). Record a multisine or a chirp to see higher frequencies."
                ),
                n=len(frequency_hz),
                highest=frequency_hz[-1],
                wanted=_FEW_LINES,
            )
        )
    poor = int(np.sum(coherence < _COHERENT))
    if poor:
        doubts.append(
            FilledTemplate(
                mark(
                    "The coherence is below {bound:g} on {n} of {lines} lines: noise, "
                    "distortion, another axis or leakage. The interval is wide there."
                ),
                bound=_COHERENT,
                n=poor,
                lines=len(coherence),
            )
        )
    if resonance is not None:
        width_hz = 2.0 * resonance.damping_ratio * resonance.frequency_hz
        if measured.method == WELCH and width_hz < _NARROW * measured.resolution_hz:
            doubts.append(
                FilledTemplate(
                    mark(
                        "The resonance is {width:.3g} Hz wide, less than {lines} lines of "
                        "{resolution:.3g} Hz: it appears flatter than it is. Average less or record"
                        " longer."
                    ),
                    width=width_hz,
                    lines=_NARROW,
                    resolution=measured.resolution_hz,
                )
            )
        if resonance.misfit > _MISFIT:
            doubts.append(
                FilledTemplate(
                    mark(
                        "A single mode misses the peak by {misfit:.0f} % (bound {bound:.0f} %): "
                        "there may be two modes, and the damping is inaccurate."
                    ),
                    misfit=100 * resonance.misfit,
                    bound=100 * _MISFIT,
                )
            )
    return doubts
