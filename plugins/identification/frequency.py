"""Frequency response of a pair of signals, with confidence interval, coherence and model."""

from typing import NamedTuple

import numpy as np

from rotemina.plugins.identification import mark, tr
from rotemina.plugins.identification.findings import (
    AnalysisCurve,
    AnalysisFindings,
    AnalysisPicture,
    ExportColumn,
    FilledTemplate,
    make_ratio_scale,
)
from rotemina.plugins.identification.nominal_response import (
    NO_NOMINAL_MODEL,
    simulate_nominal_signals,
)
from rotemina.plugins.identification.record_query import AnalysisQuestion
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError, TooShortError
from rotemina.sim.identification import (
    ExperimentSignals,
    FittedResonance,
    FrequencyResponse,
    estimate_periodic_response,
    estimate_welch_response,
    fit_resonance,
)
from rotemina.sim.messages import format_fixed, format_rounded, format_uncertain
from rotemina.sim.units import DisplayScale

CONFIDENCE_LEVEL = 0.95
WELCH, MULTISINE = "Welch", mark("multisine")
_MIN_COHERENCE = 0.8

# A peak counts as a resonance if its gain is at least this multiple of the gain of the lowest line.
_MIN_PEAK_RATIO = 2.0

# The resonance is fitted in this band, given as multiples of the peak frequency.
_FIT_BAND_RATIOS = (0.8, 1.25)

# With fewer spectral lines a notice recommends another excitation.
_MIN_LINES = 8

# Welch's method refuses shorter segments.
_MIN_SEGMENT_SAMPLES = 8

# The window of Welch's method flattens a resonance that is narrower than this many lines.
_MIN_LINES_IN_RESONANCE = 4

# If the fit of a single mode misses the peak by more than this fraction, a notice says so.
_MAX_MISFIT_RATIO = 0.1


class ResponseEstimate(NamedTuple):
    """Estimated response at k spectral lines.

    ``averages_text`` is the number of averages and their length, for display.
    """

    method: str
    averages_text: str
    resolution_hz: float
    lines: FrequencyResponse

    @property
    def values(self) -> np.ndarray:
        """Complex response (k,)."""
        return self.lines.response[:, 0, 0]

    @property
    def radius(self) -> FloatArray:
        """Radius (k,) of the confidence interval in the complex plane."""
        return self.lines.confidence_radius(CONFIDENCE_LEVEL)[:, 0, 0]


def analyse_frequency_response(question: AnalysisQuestion) -> AnalysisFindings:
    """Estimate the frequency response.

    A periodic record is averaged over its periods, and any other record by Welch's method.
    """
    signals = question.signals()
    measured = estimate_response(signals, question.averages)
    notices = []
    nominal: ResponseEstimate | None = None
    try:
        nominal = estimate_response(simulate_nominal_signals(question), question.averages)
    except (InputError, KeyError) as error:
        notices.append(FilledTemplate(NO_NOMINAL_MODEL, reason=error))
    resonance: FittedResonance | None = None
    try:
        resonance = _find_resonance(question, measured)
    except InputError as error:
        notices.append(str(error))
    scale = make_ratio_scale(question, float(np.abs(measured.values).max()))
    return AnalysisFindings(
        question,
        _make_pictures(question, scale, measured, nominal),
        (mark("figure"), mark("value")),
        _make_rows(scale, signals, measured, resonance),
        _make_columns(scale, measured, nominal),
        (*notices, *_find_notices(measured, resonance)),
    )


def estimate_response(signals: ExperimentSignals, average_count: int) -> ResponseEstimate:
    """Estimate a response over whole periods if there are at least two, or else over segments.

    The whole record is split into ``average_count`` segments.

    Raises
    ------
    TooShortError
        If the segments would be too short.
    """
    period = signals.period_samples
    if period is not None and signals.count >= 2 * period:
        response = estimate_periodic_response(signals)
        averages_text = FilledTemplate(
            mark("{n} periods of {rows}"), n=response.periods, rows=period
        )
        # The total deviation includes everything that is not linear, in addition to the noise.
        return ResponseEstimate(MULTISINE, averages_text, signals.rate_hz / period, response.total)
    # Segments overlap by half. A record of n samples is therefore split into k segments of
    # 2n / (k + 1) samples.
    segment_samples = 2 * signals.count // (average_count + 1)
    if segment_samples < _MIN_SEGMENT_SAMPLES:
        raise TooShortError(
            tr(
                "frequency response: {averages} averages of {n} samples give segments of "
                "{segment} samples; at least {least} are needed. Record longer or average "
                "less."
            ).format(
                n=signals.count,
                averages=average_count,
                segment=segment_samples,
                least=_MIN_SEGMENT_SAMPLES,
            )
        )
    response = estimate_welch_response(signals, segment=segment_samples)
    averages_text = FilledTemplate(
        mark("{n} segments of {rows}"), n=average_count, rows=segment_samples
    )
    return ResponseEstimate(WELCH, averages_text, signals.rate_hz / segment_samples, response)


def _find_resonance(
    question: AnalysisQuestion, measured: ResponseEstimate
) -> FittedResonance | None:
    frequency_hz, gain = measured.lines.frequency_hz, np.abs(measured.values)
    peak = int(np.argmax(gain))
    if gain[peak] < _MIN_PEAK_RATIO * gain[0] or not 0 < peak < len(gain) - 1:
        return None
    # The fit determines six parameters, so it needs at least four lines on each side of the peak,
    # even if the lines are far apart.
    four_below_hz = frequency_hz[max(peak - 4, 0)]
    four_above_hz = frequency_hz[min(peak + 4, len(gain) - 1)]
    band_hz = (
        min(_FIT_BAND_RATIOS[0] * frequency_hz[peak], four_below_hz),
        max(_FIT_BAND_RATIOS[1] * frequency_hz[peak], four_above_hz),
    )
    # With a lag of one sample, the input is held between samples and the output is continuous. The
    # measured response then contains the hold, which the fit must remove.
    hold_rate_hz = measured.lines.rate_hz if question.lag_samples else None
    return fit_resonance(
        frequency_hz,
        measured.values,
        band_hz=(float(band_hz[0]), float(band_hz[1])),
        deviation=measured.lines.deviation[:, 0, 0],
        held_at_hz=hold_rate_hz,
    )


def _make_pictures(
    question: AnalysisQuestion,
    scale: DisplayScale,
    measured: ResponseEstimate,
    nominal: ResponseEstimate | None,
) -> tuple[AnalysisPicture, ...]:
    frequency_hz, gain = measured.lines.frequency_hz, np.abs(measured.values)
    low, high = np.maximum(gain - measured.radius, 0.01 * gain), gain + measured.radius
    magnitude = [
        AnalysisCurve("", "quiet", frequency_hz, scale.per_si * low),
        AnalysisCurve(
            f"{format_fixed(100 * CONFIDENCE_LEVEL, 0)} %",
            "quiet",
            frequency_hz,
            scale.per_si * high,
        ),
        AnalysisCurve(mark("measured"), "real", frequency_hz, scale.per_si * gain),
    ]
    phase = [AnalysisCurve(mark("measured"), "real", frequency_hz, _compute_phase_deg(measured))]
    if nominal is not None:
        model_frequency_hz = nominal.lines.frequency_hz
        model_curve = AnalysisCurve(
            mark("model"),
            "model",
            model_frequency_hz,
            scale.per_si * np.abs(nominal.values),
            width=3,
        )
        magnitude.insert(2, model_curve)
        phase.insert(
            0,
            AnalysisCurve(
                mark("model"), "model", model_frequency_hz, _compute_phase_deg(nominal), width=3
            ),
        )
    coherence = AnalysisCurve(
        mark("measured"), "real", frequency_hz, measured.lines.coherence[:, 0]
    )
    pair = f"{question.output_tap}/{question.input_tap}"
    bottom = mark("frequency [Hz]")
    return (
        AnalysisPicture(
            f"|{pair}| [{scale.symbol or '1'}]", bottom, tuple(magnitude), log_x=True, log_y=True
        ),
        AnalysisPicture(mark("phase [°]"), bottom, tuple(phase), log_x=True),
        AnalysisPicture(mark("coherence"), bottom, (coherence,), log_x=True, y_range=(0.0, 1.05)),
    )


def _compute_phase_deg(response: ResponseEstimate) -> FloatArray:
    return np.degrees(response.lines.phase_rad[:, 0, 0])


def _make_rows(
    scale: DisplayScale,
    signals: ExperimentSignals,
    measured: ResponseEstimate,
    resonance: FittedResonance | None,
) -> tuple[tuple[str, str], ...]:
    frequency_hz, gain = measured.lines.frequency_hz, np.abs(measured.values)
    peak = int(np.argmax(gain))
    rows = [
        (mark("gain, lowest line"), scale.format_with_unit(gain[0])),
        (mark("largest gain"), scale.format_with_unit(gain[peak])),
        (mark("at frequency"), f"{format_rounded(frequency_hz[peak], 5)} Hz"),
        (mark("median coherence"), format_fixed(np.median(measured.lines.coherence), 4)),
        (mark("estimator"), measured.method),
        (mark("averages"), measured.averages_text),
        (mark("lines"), str(len(gain))),
        (mark("lowest line"), f"{format_rounded(frequency_hz[0], 5)} Hz"),
        (mark("highest line"), f"{format_rounded(frequency_hz[-1], 5)} Hz"),
        (mark("resolution"), f"{format_rounded(measured.resolution_hz)} Hz"),
        (mark("samples"), str(signals.count)),
        (mark("sampling rate"), f"{format_rounded(signals.rate_hz, 6)} Hz"),
    ]
    if resonance is None:
        return tuple(rows)
    frequency_text = format_uncertain(resonance.frequency_hz, resonance.frequency_deviation)
    frequency = f"{' ± '.join(frequency_text)} Hz"
    damping_ratio = " ± ".join(
        format_uncertain(resonance.damping_ratio, resonance.damping_deviation)
    )
    misfit = f"{format_rounded(100.0 * resonance.misfit, 3)} %"
    resonance_rows = [
        (mark("resonance"), frequency),
        (mark("damping ratio"), damping_ratio),
        (mark("misfit of the mode"), misfit),
    ]
    return (*resonance_rows, *rows)


def _make_columns(
    scale: DisplayScale, measured: ResponseEstimate, nominal: ResponseEstimate | None
) -> tuple[ExportColumn, ...]:
    unit = scale.symbol or "1"
    frequency_hz = measured.lines.frequency_hz
    columns = {
        "frequency [Hz]": frequency_hz,
        f"magnitude [{unit}]": scale.per_si * np.abs(measured.values),
        "phase [deg]": _compute_phase_deg(measured),
        f"radius of the {100 * CONFIDENCE_LEVEL:.0f} % interval [{unit}]": scale.per_si
        * measured.radius,
        "coherence [1]": measured.lines.coherence[:, 0],
    }
    # If the model was simulated with another input than the recorded one, its frequency lines
    # differ, and the columns of the model are omitted.
    if nominal is not None and np.array_equal(nominal.lines.frequency_hz, frequency_hz):
        columns[f"model magnitude [{unit}]"] = scale.per_si * np.abs(nominal.values)
        columns["model phase [deg]"] = _compute_phase_deg(nominal)
    return tuple(ExportColumn(name, tuple(map(float, values))) for name, values in columns.items())


def _find_notices(measured: ResponseEstimate, resonance: FittedResonance | None) -> list[str]:
    frequency_hz, coherence = measured.lines.frequency_hz, measured.lines.coherence[:, 0]
    notices = []
    if len(frequency_hz) < _MIN_LINES:
        notices.append(
            FilledTemplate(
                mark(
                    "The input excites only {n} lines, up to {highest:.4g} Hz ({wanted} lines "
                    "are needed). Record a multisine or a chirp to see higher frequencies."
                ),
                n=len(frequency_hz),
                highest=frequency_hz[-1],
                wanted=_MIN_LINES,
            )
        )
    low_coherence_count = int(np.sum(coherence < _MIN_COHERENCE))
    if low_coherence_count:
        notices.append(
            FilledTemplate(
                mark(
                    "The coherence is below {bound:g} on {n} of {lines} lines: noise, "
                    "distortion, another axis or leakage. The interval is wide there."
                ),
                bound=_MIN_COHERENCE,
                n=low_coherence_count,
                lines=len(coherence),
            )
        )
    if resonance is not None:
        width_hz = 2.0 * resonance.damping_ratio * resonance.frequency_hz
        if measured.method == WELCH and width_hz < _MIN_LINES_IN_RESONANCE * measured.resolution_hz:
            notices.append(
                FilledTemplate(
                    mark(
                        "The resonance is {width:.3g} Hz wide, less than {lines} lines of "
                        "{resolution:.3g} Hz: it appears flatter than it is. Average less or record"
                        " longer."
                    ),
                    width=width_hz,
                    lines=_MIN_LINES_IN_RESONANCE,
                    resolution=measured.resolution_hz,
                )
            )
        if resonance.misfit > _MAX_MISFIT_RATIO:
            notices.append(
                FilledTemplate(
                    mark(
                        "A single mode misses the peak by {misfit:.0f} % (bound {bound:.0f} %): "
                        "there may be two modes, and the damping is inaccurate."
                    ),
                    misfit=100 * resonance.misfit,
                    bound=100 * _MAX_MISFIT_RATIO,
                )
            )
    return notices
