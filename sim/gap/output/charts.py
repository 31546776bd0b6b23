"""Charts of a diagnosis: shrinkage of the gap, candidates, and predictions of an experiment."""

from collections.abc import Sequence
from itertools import cycle
from math import isfinite

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from rotemina.sim.arrays import FloatArray, decimate_to_envelope
from rotemina.sim.gap.output.report_words import (
    localize,
    localize_effect_title,
    localize_name,
    localize_text,
)
from rotemina.sim.gap.output.svg_pictures import (
    ColourRole,
    add_legend,
    draw_picture,
    shorten_name,
)
from rotemina.sim.gap.result import (
    GapShrinkage,
    RankedCandidate,
    SuggestedExperiment,
)
from rotemina.sim.messages import format_rounded, marked
from rotemina.sim.records import Tap
from rotemina.sim.units import choose_scale, format_percent

_WIDTH_IN = 10.0
_BUCKET_COUNT = 500
_MAX_CANDIDATES = 14
# The scale is logarithmic if the longest bar is more than this many times the shortest one.
_MIN_LOG_SCALE_RATIO = 8.0
_RIVAL_STYLES = (
    (ColourRole.CORRECTED, "-"),
    (ColourRole.REAL, "--"),
    (ColourRole.THIRD, "-."),
    (ColourRole.FOURTH, ":"),
)


def draw_waterfall(shrinkage: GapShrinkage, unit: str) -> Markup:
    """Draw the gap of the original model, the re-tuned model, and with each effect in turn."""
    scale = choose_scale(unit, shrinkage.raw)
    bars = [
        (localize_text(marked("gap", "original model")), shrinkage.raw),
        (localize_text(marked("gap", "re-tuned")), shrinkage.retuned),
    ]
    bars += [
        (f"+ {shorten_name(localize_effect_title(step.effect))}", step.rms)
        for step in shrinkage.steps
    ]
    bars.append((localize_text(marked("gap", "corrected")), shrinkage.corrected))
    bars = [(name, rms) for name, rms in bars if isfinite(rms)]
    bounds = [(shrinkage.floor, ColourRole.FLOOR, localize_text(marked("gap", "noise floor")))]
    if shrinkage.ceiling is not None and isfinite(shrinkage.ceiling):
        bounds.append(
            (shrinkage.ceiling, ColourRole.CEILING, localize_text(marked("gap", "black-box model")))
        )

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        bar_lengths = scale(np.array([rms for _, rms in bars]))
        rows = np.arange(len(bars))
        colours = [ColourRole.RAW, ColourRole.RAW, *[ColourRole.CORRECTED] * (len(bars) - 2)]
        _fit_scale(axes, np.array([*bar_lengths, *(rms * scale.per_si for rms, _, _ in bounds)]))
        # A bar cannot begin at zero on a logarithmic scale, so it begins at the left end.
        left_end = axes.get_xlim()[0]
        axes.barh(rows, bar_lengths - left_end, left=left_end, color=colours, height=0.62)
        for row, bar_length in enumerate(bar_lengths):
            axes.annotate(
                localize(format_rounded(bar_length)),
                (bar_length, row),
                (4, 0),
                textcoords="offset points",
                va="center",
            )
        for rms, role, name in bounds:
            axes.axvline(rms * scale.per_si, color=role, linestyle="--", label=name)
        axes.set_yticks(rows, [name for name, _ in bars])
        axes.invert_yaxis()
        axes.grid(visible=False, axis="y")
        axes.set_xlabel(localize_text(marked("gap", "gap, rms [{unit}]"), unit=scale.symbol))
        add_legend(figure, axes)

    bar_texts = ", ".join(f"{name} {localize(scale.format_with_unit(rms))}" for name, rms in bars)
    about = localize_text(marked("gap", "Waterfall of the gap: {bars}"), bars=bar_texts)
    return draw_picture(_WIDTH_IN, 1.1 + 0.3 * len(bars), draw, about)


def draw_ranking(candidates: Sequence[RankedCandidate]) -> Markup | None:
    """Draw the remaining gap of each candidate on validation data, most likely candidate on top.

    Candidates that could not be simulated are omitted. Returns None if none remains.
    """
    finite_candidates = [candidate for candidate in candidates if isfinite(candidate.held_out_rms)]
    drawn_candidates = [
        candidate
        for candidate in finite_candidates
        if all(map(isfinite, candidate.held_out_interval))
    ][:_MAX_CANDIDATES]
    if not drawn_candidates:
        return None

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        rows = np.arange(len(drawn_candidates))
        held_out_rms = np.array([candidate.held_out_rms for candidate in drawn_candidates])
        intervals = np.array([candidate.held_out_interval for candidate in drawn_candidates])
        axes.hlines(
            rows, intervals[:, 0], intervals[:, 1], color=ColourRole.CORRECTED, linewidth=2.5
        )
        axes.plot(held_out_rms, rows, "o", color=ColourRole.CORRECTED, markersize=5)
        for row, candidate in enumerate(drawn_candidates):
            axes.annotate(
                localize(format_percent(candidate.probability)),
                (max(candidate.held_out_rms, candidate.held_out_interval[1]), row),
                (6, 0),
                textcoords="offset points",
                va="center",
            )
        axes.set_yticks(rows, [name_candidate(candidate) for candidate in drawn_candidates])
        axes.set_ylim(len(drawn_candidates) - 0.4, -0.6)
        _fit_scale(axes, np.concatenate([held_out_rms, intervals.ravel()]))
        axes.set_xlabel(
            localize_text(
                marked("gap", "remainder on unseen data, rms [noise floors]; with probability")
            )
        )

    names = ", ".join(map(name_candidate, drawn_candidates))
    about = localize_text(marked("gap", "Candidates, most likely first: {names}"), names=names)
    return draw_picture(_WIDTH_IN, 0.9 + 0.27 * len(drawn_candidates), draw, about)


def name_candidate(candidate: RankedCandidate) -> str:
    """Return the name of a candidate, with the source axis and formulation of the effect."""
    name = shorten_name(localize_effect_title(candidate.effect))
    if candidate.from_axis is not None:
        name = localize_text(
            marked("gap", "{effect} from {axis}"),
            effect=name,
            axis=shorten_name(candidate.from_axis),
        )
    return (
        f"{name} ({shorten_name(localize_name(candidate.formulation))})"
        if candidate.formulation
        else name
    )


def draw_forecast(experiment: SuggestedExperiment, unit: str) -> Markup:
    """Draw the prediction of each rival for an experiment, and its difference from the first."""
    time_s = np.array(experiment.time_s)
    predictions = {name: np.array(values) for name, values in experiment.predictions.items()}
    command = np.array(experiment.commands.get(experiment.axis, ()))
    reference_name, reference = next(iter(predictions.items()))

    def draw(figure: Figure) -> None:
        upper_axes, lower_axes = figure.subplots(2, 1, sharex=True)
        scale = choose_scale(unit, float(np.abs(reference).max()))
        if len(command) and experiment.tap is not Tap.U:
            _draw_line(
                upper_axes,
                time_s,
                scale(command),
                ColourRole.QUIET,
                "-",
                localize_text(marked("gap", "command")),
            )
        differences = {name: prediction - reference for name, prediction in predictions.items()}
        difference_scale = choose_scale(
            unit, max(float(np.abs(difference).max()) for difference in differences.values())
        )
        for (name, prediction), (role, dashes) in zip(
            predictions.items(), cycle(_RIVAL_STYLES), strict=False
        ):
            _draw_line(
                upper_axes,
                time_s,
                scale(prediction),
                role,
                dashes,
                shorten_name(localize_effect_title(name)),
            )
            _draw_line(lower_axes, time_s, difference_scale(differences[name]), role, dashes, "")
        upper_axes.set_ylabel(f"{experiment.tap} [{scale.symbol}]")
        lower_axes.set_ylabel(
            localize_text(
                marked("gap", "minus that of\n{effect} [{unit}]"),
                effect=shorten_name(localize_effect_title(reference_name)),
                unit=difference_scale.symbol,
            )
        )
        lower_axes.set_xlabel(localize_text(marked("gap", "time [s]")))
        add_legend(figure, upper_axes)

    rivals = ", ".join(localize_effect_title(name) for name in predictions)
    about = localize_text(
        marked("gap", "Predictions of {rivals} for the suggested experiment"), rivals=rivals
    )
    return draw_picture(_WIDTH_IN, 4.2, draw, about)


def set_log_scale(axes: Axes, side: str) -> None:
    """Set a logarithmic scale whose ticks are plain numbers."""
    axes.set(**{f"{side}scale": "log"})
    axis = axes.xaxis if side == "x" else axes.yaxis
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=9))
    axis.set_major_formatter(FuncFormatter(lambda value, _: localize(format_rounded(value, 6))))
    axis.set_minor_formatter(NullFormatter())


def _fit_scale(axes: Axes, values: FloatArray) -> None:
    """Fit the horizontal scale to values (n,), with room for a number after the longest bar."""
    positive = values[values > 0.0]
    if len(positive) and positive.max() > _MIN_LOG_SCALE_RATIO * positive.min():
        set_log_scale(axes, "x")
        low, high = float(positive.min()), float(positive.max())
        axes.set_xlim(0.7 * low, high * (high / low) ** 0.12)
    else:
        axes.set_xlim(0.0, 1.15 * float(values.max(initial=0.0)) or 1.0)


def _draw_line(
    axes: Axes, time_s: FloatArray, values: FloatArray, role: ColourRole, dashes: str, name: str
) -> None:
    axes.plot(*decimate_to_envelope(time_s, values, _BUCKET_COUNT), dashes, color=role, label=name)
