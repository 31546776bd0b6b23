"""A low-order model fitted to the pair: natural frequency, damping, gain, and quality."""

from dataclasses import replace

import numpy as np

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.filled_template import FilledTemplate
from rotemina.plugins.identification.findings import (
    NONE,
    Column,
    Curve,
    Findings,
    Picture,
    ratio_scale,
)
from rotemina.plugins.identification.nominal_response import ABSENT, nominal_signals
from rotemina.plugins.identification.record_query import Question
from rotemina.sim.errors import InputError
from rotemina.sim.identification.arx import identify_arx
from rotemina.sim.identification.experiment_signals import Signals
from rotemina.sim.identification.model import IdentifiedModel, Orders, simulate
from rotemina.sim.identification.natural_modes import BAND_SHARE, NaturalMode, natural_modes
from rotemina.sim.identification.output_error import identify_oe
from rotemina.sim.quantities import Scale, fixed, scale_of, uncertain

MOST_ROWS = 100_000  # fitted within a second; a mode is known well long before
METHODS = {"oe": identify_oe, "arx": identify_arx}
_GOOD_FIT = 80.0
_WORSE = 10.0  # per cent of fit, lost from prediction to simulation, that tell of noise
_ROUGH = 0.1  # relative deviation from which a figure is rough
_HEAD = (mark("figure"), mark("value"), mark("± deviation"), mark("model"))


def model_findings(question: Question) -> Findings:
    """Fit a discrete transfer function and say what it means, or why it means little."""
    whole = question.signals()
    signals = _cut(whole)
    orders = Orders(question.poles, question.poles, question.lag_samples)
    model = METHODS[question.method](signals, orders)
    modes = natural_modes(model)
    nominal, absent = _nominal_rows(question, orders)
    notices = []
    if whole.count > signals.count:
        notices.append(
            FilledTemplate(
                mark("The fit uses the first {n} of {rows} rows, to save time."),
                n=signals.count,
                rows=whole.count,
            )
        )
    columns = _columns(model)
    return Findings(
        question,
        _pictures(question, model, signals),
        _HEAD,
        _beside(_rows(question, model, modes), nominal),
        columns,
        (*notices, *absent, *_doubts(model, modes)),
    )


def _nominal_rows(
    question: Question, orders: Orders
) -> tuple[tuple[tuple[str, ...], ...], tuple[str, ...]]:
    """Fit the nominal model's answer in the same way; return its rows, or why there are none."""
    try:
        model = METHODS[question.method](_cut(nominal_signals(question)), orders)
        return _rows(question, model, natural_modes(model)), ()
    except (InputError, KeyError) as error:
        return (), (FilledTemplate(ABSENT, reason=error),)


def _beside(
    rows: tuple[tuple[str, ...], ...], nominal: tuple[tuple[str, ...], ...]
) -> tuple[tuple[str, ...], ...]:
    """Return rows with the nominal model's value behind each: the n-th of a name to the n-th."""
    left: dict[str, list[str]] = {}
    for name, value, _ in nominal:
        left.setdefault(name, []).append(value)
    return tuple((*row, left[row[0]].pop(0) if left.get(row[0]) else NONE) for row in rows)


def _cut(signals: Signals) -> Signals:
    return replace(signals, inputs=signals.inputs[:MOST_ROWS], outputs=signals.outputs[:MOST_ROWS])


def _pictures(question: Question, model: IdentifiedModel, signals: Signals) -> tuple[Picture, ...]:
    measured = signals.outputs[:, 0]
    output = simulate(model.transfer_function, signals).output
    if not np.isfinite(output).all():
        return ()
    unit = question.unit(question.answer)
    time_s = np.arange(signals.count) / signals.rate_hz
    gap = measured - output
    scale, fine = (scale_of(unit, float(np.abs(each).max())) for each in (measured, gap))
    return (
        Picture(
            f"{question.answer} [{scale.symbol}]",
            mark("time [s]"),
            (
                Curve(mark("fitted"), "good", time_s, scale.per_si * output, width=3),
                Curve(mark("measured"), "real", time_s, scale.per_si * measured),
            ),
        ),
        Picture(
            FilledTemplate(mark("measured − fitted [{unit}]"), unit=fine.symbol),
            mark("time [s]"),
            (Curve("", "text", time_s, fine.per_si * gap),),
        ),
    )


def _rows(
    question: Question, model: IdentifiedModel, modes: tuple[NaturalMode, ...]
) -> tuple[tuple[str, ...], ...]:
    gain = model.transfer_function.static_gain
    scale = ratio_scale(question, abs(gain))
    rows: list[tuple[str, ...]] = [(mark("fit"), f"{fixed(model.fit_percent, 2)} %", "")]
    if model.prediction_percent is not None:
        rows.append((mark("fit one step ahead"), f"{fixed(model.prediction_percent, 2)} %", ""))
    for mode in modes:
        rows += _mode_rows(mode)
    rows.append((mark("static gain"), scale.text(gain), scale.text(model.static_gain_deviation)))
    unit = question.unit(question.answer)
    residual = scale_of(unit, model.residual_rms).text(model.residual_rms)
    rows.append((mark("residual rms"), residual, ""))
    rows.append((mark("delay in samples"), str(model.transfer_function.delay), ""))
    return tuple(rows)


def _mode_rows(mode: NaturalMode) -> list[tuple[str, ...]]:
    frequency, doubt = uncertain(mode.frequency_hz, mode.frequency_deviation)
    found = (f"{frequency} Hz", f"{doubt} Hz")
    if mode.oscillates:
        ratio = uncertain(mode.damping_ratio, mode.damping_deviation)
        return [(mark("natural frequency"), *found), (mark("damping ratio"), *ratio)]
    lag_s = 1.0 / (2.0 * np.pi * mode.frequency_hz) if mode.frequency_hz else np.inf
    return [
        (mark("corner frequency"), *found),
        (mark("time constant"), Scale("ms", 1e3).text(lag_s), NONE),
    ]


def _columns(model: IdentifiedModel) -> tuple[Column, ...]:
    """Return the transfer function itself: what another program needs to continue."""
    transfer = model.transfer_function
    above = tuple(map(float, transfer.numerator))
    below = tuple(map(float, transfer.denominator))
    length = max(len(above), len(below))

    def filled(values: tuple[float, ...]) -> tuple[float | None, ...]:
        return values + (None,) * (length - len(values))

    powers = tuple(float(power) for power in range(length))
    return (
        Column("power of z^-1 [1]", powers),
        Column(f"numerator after {transfer.delay} samples of delay [SI]", filled(above)),
        Column("denominator [1]", filled(below)),
    )


def _doubts(model: IdentifiedModel, modes: tuple[NaturalMode, ...]) -> list[str]:
    doubts = []
    transfer = model.transfer_function
    if not transfer.stable:
        doubts.append(
            mark(
                "The fitted model is unstable: it describes noise or drift. Choose the "
                "method output error."
            )
        )
    elif model.fit_percent < _GOOD_FIT:
        doubts.append(
            FilledTemplate(
                mark(
                    "The fit of {fit:.1f} % is below {bound:g} %: noise, distortion, another "
                    "axis or too few poles. Frequency and damping are not those of the machine."
                ),
                fit=model.fit_percent,
                bound=_GOOD_FIT,
            )
        )
    predicted = model.prediction_percent
    if predicted is not None and transfer.stable and predicted - model.fit_percent > _WORSE:
        doubts.append(
            FilledTemplate(
                mark(
                    "The model fits {ahead:.1f} % one step ahead but {fit:.1f} % in simulation:"
                    " sensor noise biases ARX. Choose the method output error."
                ),
                ahead=predicted,
                fit=model.fit_percent,
            )
        )
    if modes:
        doubts += _mode_doubts(modes[0], transfer.rate_hz)
    return doubts


def _mode_doubts(mode: NaturalMode, rate_hz: float) -> list[str]:
    doubts = []
    highest_hz = BAND_SHARE * rate_hz / 2.0
    if not mode.oscillates:
        doubts.append(mark("The leading pole is real: the record shows a lag, no resonance."))
    if mode.frequency_hz > highest_hz:
        doubts.append(
            FilledTemplate(
                mark(
                    "{mode:.4g} Hz is above {highest:.4g} Hz, {share:g} of half the sampling "
                    "rate: it is a delay or noise, not a mode of the machine."
                ),
                mode=mode.frequency_hz,
                highest=highest_hz,
                share=BAND_SHARE,
            )
        )
    elif mode.frequency_deviation > _ROUGH * mode.frequency_hz:
        doubts.append(
            FilledTemplate(
                mark(
                    "The frequency is uncertain by {deviation:.2g} Hz, more than {rough:.0f} %:"
                    " the record hardly excites the mode. Use faster steps or a multisine."
                ),
                deviation=mode.frequency_deviation,
                rough=100 * _ROUGH,
            )
        )
    return doubts
