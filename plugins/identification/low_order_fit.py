"""Low-order model fitted to a pair of signals, with its modes, static gain and quality."""

from dataclasses import replace

import numpy as np

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.findings import (
    NO_VALUE,
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
from rotemina.sim.errors import InputError
from rotemina.sim.identification import (
    MAX_MODE_NYQUIST_RATIO,
    ExperimentSignals,
    IdentifiedModel,
    ModelOrders,
    NaturalMode,
    find_natural_modes,
    identify_arx,
    identify_oe,
    simulate,
)
from rotemina.sim.messages import format_fixed, format_uncertain
from rotemina.sim.units import DisplayScale, choose_scale

# A fit to this many rows takes about a second. Far fewer are enough to determine a mode.
MAX_FITTED_ROWS = 100_000

FIT_METHODS = {"oe": identify_oe, "arx": identify_arx}
_MIN_FIT_PERCENT = 80.0

# If the fit is worse in simulation than one step ahead by more than this, noise biases the model.
_MAX_SIMULATION_LOSS_PERCENT = 10.0

# If its relative standard deviation is larger than this, a frequency is uncertain.
_MAX_DEVIATION_RATIO = 0.1
_HEADINGS = (mark("figure"), mark("value"), mark("± deviation"), mark("model"))


def fit_low_order_model(question: AnalysisQuestion) -> AnalysisFindings:
    """Fit a discrete transfer function, and add notices if its figures may be misleading."""
    all_signals = question.signals()
    signals = _limit_rows(all_signals)
    orders = ModelOrders(question.poles, question.poles, question.lag_samples)
    model = FIT_METHODS[question.method](signals, orders)
    modes = find_natural_modes(model)
    nominal_rows, nominal_notices = _fit_nominal_model(question, orders)
    notices = []
    if all_signals.count > signals.count:
        notices.append(
            FilledTemplate(
                mark("The fit uses the first {n} of {rows} rows, to save time."),
                n=signals.count,
                rows=all_signals.count,
            )
        )
    columns = _make_columns(model)
    return AnalysisFindings(
        question,
        _make_pictures(question, model, signals),
        _HEADINGS,
        _with_nominal_values(_make_rows(question, model, modes), nominal_rows),
        columns,
        (*notices, *nominal_notices, *_find_notices(model, modes)),
    )


def _fit_nominal_model(
    question: AnalysisQuestion, orders: ModelOrders
) -> tuple[tuple[tuple[str, ...], ...], tuple[str, ...]]:
    """Fit the response of the nominal model in the same way.

    Return the rows of the table, and a notice if there are none.
    """
    try:
        model = FIT_METHODS[question.method](
            _limit_rows(simulate_nominal_signals(question)), orders
        )
        return _make_rows(question, model, find_natural_modes(model)), ()
    except (InputError, KeyError) as error:
        return (), (FilledTemplate(NO_NOMINAL_MODEL, reason=error),)


def _with_nominal_values(
    rows: tuple[tuple[str, ...], ...], nominal_rows: tuple[tuple[str, ...], ...]
) -> tuple[tuple[str, ...], ...]:
    """Return rows with the value of the nominal model appended.

    If several rows have the same name, the n-th one gets the n-th value of the model.
    """
    values_by_name: dict[str, list[str]] = {}
    for name, value, _ in nominal_rows:
        values_by_name.setdefault(name, []).append(value)
    return tuple(
        (*row, values_by_name[row[0]].pop(0) if values_by_name.get(row[0]) else NO_VALUE)
        for row in rows
    )


def _limit_rows(signals: ExperimentSignals) -> ExperimentSignals:
    return replace(
        signals,
        inputs=signals.inputs[:MAX_FITTED_ROWS],
        outputs=signals.outputs[:MAX_FITTED_ROWS],
    )


def _make_pictures(
    question: AnalysisQuestion, model: IdentifiedModel, signals: ExperimentSignals
) -> tuple[AnalysisPicture, ...]:
    measured = signals.outputs[:, 0]
    fitted = simulate(model.transfer_function, signals).output
    if not np.isfinite(fitted).all():
        return ()
    unit = question.unit(question.output_tap)
    time_s = np.arange(signals.count) / signals.rate_hz
    residual = measured - fitted
    scale, residual_scale = (
        choose_scale(unit, float(np.abs(signal).max())) for signal in (measured, residual)
    )
    return (
        AnalysisPicture(
            f"{question.output_tap} [{scale.symbol}]",
            mark("time [s]"),
            (
                AnalysisCurve(mark("fitted"), "good", time_s, scale.per_si * fitted, width=3),
                AnalysisCurve(mark("measured"), "real", time_s, scale.per_si * measured),
            ),
        ),
        AnalysisPicture(
            FilledTemplate(mark("measured − fitted [{unit}]"), unit=residual_scale.symbol),
            mark("time [s]"),
            (AnalysisCurve("", "text", time_s, residual_scale.per_si * residual),),
        ),
    )


def _make_rows(
    question: AnalysisQuestion, model: IdentifiedModel, modes: tuple[NaturalMode, ...]
) -> tuple[tuple[str, ...], ...]:
    gain = model.transfer_function.static_gain
    scale = make_ratio_scale(question, abs(gain))
    rows: list[tuple[str, ...]] = [(mark("fit"), f"{format_fixed(model.fit_percent, 2)} %", "")]
    if model.prediction_percent is not None:
        rows.append(
            (mark("fit one step ahead"), f"{format_fixed(model.prediction_percent, 2)} %", "")
        )
    for mode in modes:
        rows += _make_mode_rows(mode)
    rows.append(
        (
            mark("static gain"),
            scale.format_with_unit(gain),
            scale.format_with_unit(model.static_gain_deviation),
        )
    )
    unit = question.unit(question.output_tap)
    residual = choose_scale(unit, model.residual_rms).format_with_unit(model.residual_rms)
    rows.append((mark("residual rms"), residual, ""))
    rows.append((mark("delay in samples"), str(model.transfer_function.delay), ""))
    return tuple(rows)


def _make_mode_rows(mode: NaturalMode) -> list[tuple[str, ...]]:
    frequency, deviation = format_uncertain(mode.frequency_hz, mode.frequency_deviation)
    frequency_texts = (f"{frequency} Hz", f"{deviation} Hz")
    if mode.oscillates:
        damping_texts = format_uncertain(mode.damping_ratio, mode.damping_deviation)
        return [
            (mark("natural frequency"), *frequency_texts),
            (mark("damping ratio"), *damping_texts),
        ]
    time_constant_s = 1.0 / (2.0 * np.pi * mode.frequency_hz) if mode.frequency_hz else np.inf
    return [
        (mark("corner frequency"), *frequency_texts),
        (
            mark("time constant"),
            DisplayScale("ms", 1e3).format_with_unit(time_constant_s),
            NO_VALUE,
        ),
    ]


def _make_columns(model: IdentifiedModel) -> tuple[ExportColumn, ...]:
    transfer_function = model.transfer_function
    numerator = tuple(map(float, transfer_function.numerator))
    denominator = tuple(map(float, transfer_function.denominator))
    length = max(len(numerator), len(denominator))

    def pad(values: tuple[float, ...]) -> tuple[float | None, ...]:
        return values + (None,) * (length - len(values))

    powers = tuple(float(power) for power in range(length))
    return (
        ExportColumn("power of z^-1 [1]", powers),
        ExportColumn(
            f"numerator after {transfer_function.delay} samples of delay [SI]", pad(numerator)
        ),
        ExportColumn("denominator [1]", pad(denominator)),
    )


def _find_notices(model: IdentifiedModel, modes: tuple[NaturalMode, ...]) -> list[str]:
    notices = []
    transfer_function = model.transfer_function
    if not transfer_function.stable:
        notices.append(
            mark(
                "The fitted model is unstable: it describes noise or drift. Choose the "
                "method output error."
            )
        )
    elif model.fit_percent < _MIN_FIT_PERCENT:
        notices.append(
            FilledTemplate(
                mark(
                    "The fit of {fit:.1f} % is below {bound:g} %: noise, distortion, another "
                    "axis or too few poles. Frequency and damping are not those of the machine."
                ),
                fit=model.fit_percent,
                bound=_MIN_FIT_PERCENT,
            )
        )
    prediction_percent = model.prediction_percent
    if (
        prediction_percent is not None
        and transfer_function.stable
        and prediction_percent - model.fit_percent > _MAX_SIMULATION_LOSS_PERCENT
    ):
        notices.append(
            FilledTemplate(
                mark(
                    "The model fits {ahead:.1f} % one step ahead but {fit:.1f} % in simulation:"
                    " sensor noise biases ARX. Choose the method output error."
                ),
                ahead=prediction_percent,
                fit=model.fit_percent,
            )
        )
    if modes:
        notices += _find_mode_notices(modes[0], transfer_function.rate_hz)
    return notices


def _find_mode_notices(mode: NaturalMode, rate_hz: float) -> list[str]:
    notices = []
    highest_hz = MAX_MODE_NYQUIST_RATIO * rate_hz / 2.0
    if not mode.oscillates:
        notices.append(mark("The leading pole is real: the record shows a lag, no resonance."))
    if mode.frequency_hz > highest_hz:
        notices.append(
            FilledTemplate(
                mark(
                    "{mode:.4g} Hz is above {highest:.4g} Hz, {share:g} of half the sampling "
                    "rate: it is a delay or noise, not a mode of the machine."
                ),
                mode=mode.frequency_hz,
                highest=highest_hz,
                share=MAX_MODE_NYQUIST_RATIO,
            )
        )
    elif mode.frequency_deviation > _MAX_DEVIATION_RATIO * mode.frequency_hz:
        notices.append(
            FilledTemplate(
                mark(
                    "The frequency is uncertain by {deviation:.2g} Hz, more than {rough:.0f} %:"
                    " the record hardly excites the mode. Use faster steps or a multisine."
                ),
                deviation=mode.frequency_deviation,
                rough=100 * _MAX_DEVIATION_RATIO,
            )
        )
    return notices
