"""Charts of a diagnosis: how the gap shrinks, and the candidates."""

from collections.abc import Sequence
from itertools import cycle
from math import isfinite

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from rotemina.sim.arrays import FloatArray
from rotemina.sim.decimation import envelope
from rotemina.sim.gap.diagnosis import Experiment, Ranked, Shrinkage
from rotemina.sim.gap.output.report.pictures import Role, legend, picture, short
from rotemina.sim.gap.output.report.words import effect_title, named, said, shown
from rotemina.sim.messages import marked
from rotemina.sim.quantities import percent, rounded, scale_of
from rotemina.sim.records.record import Tap

_WIDTH = 10.0
_BUCKETS = 500
_MOST_RANKED = 14
_LOGARITHMIC = 8.0  # ratio of the longest bar to the shortest from which their scale is so
_RIVALS = ((Role.CORRECTED, "-"), (Role.REAL, "--"), (Role.THIRD, "-."), (Role.FOURTH, ":"))


def waterfall(shrinkage: Shrinkage, unit: str) -> Markup:
    """Draw the original gap, re-tuned and after each effect, with floor and ceiling."""
    scale = scale_of(unit, shrinkage.raw)
    bars = [
        (said(marked("gap", "original model")), shrinkage.raw),
        (said(marked("gap", "re-tuned")), shrinkage.retuned),
    ]
    bars += [(f"+ {short(effect_title(step.effect))}", step.rms) for step in shrinkage.steps]
    bars.append((said(marked("gap", "corrected")), shrinkage.corrected))
    bars = [(name, rms) for name, rms in bars if isfinite(rms)]
    lines = [(shrinkage.floor, Role.FLOOR, said(marked("gap", "noise floor")))]
    if shrinkage.ceiling is not None and isfinite(shrinkage.ceiling):
        lines.append((shrinkage.ceiling, Role.CEILING, said(marked("gap", "black-box model"))))

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        sizes = scale(np.array([rms for _, rms in bars]))
        rows = np.arange(len(bars))
        colours = [Role.RAW, Role.RAW, *[Role.CORRECTED] * (len(bars) - 2)]
        _fit(axes, np.array([*sizes, *(rms * scale.per_si for rms, _, _ in lines)]))
        least = axes.get_xlim()[0]  # a bar that begins at zero has no end on a logarithmic scale
        axes.barh(rows, sizes - least, left=least, color=colours, height=0.62)
        for row, size in enumerate(sizes):
            axes.annotate(
                shown(rounded(size)), (size, row), (4, 0), textcoords="offset points", va="center"
            )
        for rms, role, name in lines:
            axes.axvline(rms * scale.per_si, color=role, linestyle="--", label=name)
        axes.set_yticks(rows, [name for name, _ in bars])
        axes.invert_yaxis()
        axes.grid(visible=False, axis="y")
        axes.set_xlabel(said(marked("gap", "gap, rms [{unit}]"), unit=scale.symbol))
        legend(figure, axes)

    told = ", ".join(f"{name} {shown(scale.text(rms))}" for name, rms in bars)
    about = said(marked("gap", "Waterfall of the gap: {bars}"), bars=told)
    return picture(_WIDTH, 1.1 + 0.3 * len(bars), draw, about)


def ranking(candidates: Sequence[Ranked]) -> Markup | None:
    """Draw what each candidate leaves on data that its fit did not see, likeliest on top.

    One that could not be simulated has no place; None where none has.
    """
    sure = [one for one in candidates if isfinite(one.held_out_rms)]
    ranked = [one for one in sure if all(map(isfinite, one.held_out_interval))][:_MOST_RANKED]
    if not ranked:
        return None

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        rows = np.arange(len(ranked))
        middle = np.array([one.held_out_rms for one in ranked])
        ends = np.array([one.held_out_interval for one in ranked])
        axes.hlines(rows, ends[:, 0], ends[:, 1], color=Role.CORRECTED, linewidth=2.5)
        axes.plot(middle, rows, "o", color=Role.CORRECTED, markersize=5)
        for row, one in enumerate(ranked):
            axes.annotate(
                shown(percent(one.probability)),
                (max(one.held_out_rms, one.held_out_interval[1]), row),
                (6, 0),
                textcoords="offset points",
                va="center",
            )
        axes.set_yticks(rows, [candidate_name(one) for one in ranked])
        axes.set_ylim(len(ranked) - 0.4, -0.6)
        _fit(axes, np.concatenate([middle, ends.ravel()]))
        axes.set_xlabel(
            said(marked("gap", "remainder on unseen data, rms [noise floors]; with probability"))
        )

    names = ", ".join(map(candidate_name, ranked))
    about = said(marked("gap", "Candidates, most likely first: {names}"), names=names)
    return picture(_WIDTH, 0.9 + 0.27 * len(ranked), draw, about)


def candidate_name(one: Ranked) -> str:
    """Return a candidate's name, with what sets it apart from others of its effect."""
    name = short(effect_title(one.effect))
    if one.from_axis is not None:
        name = said(marked("gap", "{effect} from {axis}"), effect=name, axis=short(one.from_axis))
    return f"{name} ({short(named(one.formulation))})" if one.formulation else name


def forecast(experiment: Experiment, unit: str) -> Markup:
    """Draw what each rival says of a suggested experiment, and how far they part."""
    time_s = np.array(experiment.time_s)
    answers = {name: np.array(values) for name, values in experiment.predictions.items()}
    command = np.array(experiment.commands.get(experiment.axis, ()))
    first, one = next(iter(answers.items()))

    def draw(figure: Figure) -> None:
        whole, apart = figure.subplots(2, 1, sharex=True)
        scale = scale_of(unit, float(np.abs(one).max()))
        if len(command) and experiment.tap is not Tap.U:
            _line(whole, time_s, scale(command), Role.QUIET, "-", said(marked("gap", "command")))
        far = {name: answer - one for name, answer in answers.items()}
        fine = scale_of(unit, max(float(np.abs(each).max()) for each in far.values()))
        for (name, answer), (role, dashes) in zip(answers.items(), cycle(_RIVALS), strict=False):
            _line(whole, time_s, scale(answer), role, dashes, short(effect_title(name)))
            _line(apart, time_s, fine(far[name]), role, dashes, "")
        whole.set_ylabel(f"{experiment.tap} [{scale.symbol}]")
        apart.set_ylabel(
            said(
                marked("gap", "minus that of\n{effect} [{unit}]"),
                effect=short(effect_title(first)),
                unit=fine.symbol,
            )
        )
        apart.set_xlabel(said(marked("gap", "time [s]")))
        legend(figure, whole)

    rivals = ", ".join(effect_title(name) for name in answers)
    about = said(
        marked("gap", "Predictions of {rivals} for the suggested experiment"), rivals=rivals
    )
    return picture(_WIDTH, 4.2, draw, about)


def plain_logarithm(axes: Axes, side: str) -> None:
    """Make a logarithmic scale whose numbers are plain."""
    axes.set(**{f"{side}scale": "log"})
    line = axes.xaxis if side == "x" else axes.yaxis
    line.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=9))
    line.set_major_formatter(FuncFormatter(lambda value, _: shown(rounded(value, 6))))
    line.set_minor_formatter(NullFormatter())


def _fit(axes: Axes, values: FloatArray) -> None:
    """Let the horizontal scale hold values (n,) with room for a number behind the last."""
    above = values[values > 0.0]
    if len(above) and above.max() > _LOGARITHMIC * above.min():
        plain_logarithm(axes, "x")
        low, high = float(above.min()), float(above.max())
        axes.set_xlim(0.7 * low, high * (high / low) ** 0.12)
    else:
        axes.set_xlim(0.0, 1.15 * float(values.max(initial=0.0)) or 1.0)


def _line(
    axes: Axes, time_s: FloatArray, values: FloatArray, role: Role, dashes: str, name: str
) -> None:
    axes.plot(*envelope(time_s, values, _BUCKETS), dashes, color=role, label=name)
