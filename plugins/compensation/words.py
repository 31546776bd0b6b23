"""Text and numbers of the panel; free of widgets."""

from collections.abc import Mapping

from rotemina.app.display_units import label
from rotemina.app.shell.engine_words import spoken
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.trial_motion import Trial
from rotemina.sim.compensate.inverse import Exceedance
from rotemina.sim.compensate.inverse_parameters import Kind
from rotemina.sim.compensate.judgement import NAMES
from rotemina.sim.compensate.training import Trained
from rotemina.sim.quantities import amount, percent
from rotemina.sim.tuning.pareto_front import Point

HEAD = (mark("inverse"), mark("rms"), mark("worst"), mark("of range"))
NOTHING = mark("There is no inverse: train one, or open a file.")
NO_FRONT = mark("there is no front: tune, or open gains")
LIVE_LOOP = mark(
    "The simulated machine closes the loop live at 5 kHz, only if it is also "
    "stable on axes off by 5 %. The boards close no loop: there, only "
    "feed-forward is possible."
)
AT_A_LIMIT = mark(
    "The loop demands more than the range of the axis: move the axis away from the end."
)
SWEEP = mark(
    "Sweep the whole range of the inverse to erase the history of the axis: this removes most of "
    "a constant error (a loop removes it anyway)"
)
# What the buttons that put on and take off say, each before and after.
SWITCH = (mark("Apply"), mark("Remove"))
APPLY = (mark("Apply gains"), mark("Open loop"))
_SAID = {
    Exceedance.LOW: mark("below its training range (clamped)"),
    Exceedance.HIGH: mark("above its training range (clamped)"),
    Exceedance.FAST: mark("faster than in training"),
    Exceedance.COMMAND: mark("at an end of the machine's range (clamped)"),
}


def judged(trained: Trained) -> tuple[tuple[str, ...], ...]:
    """Return the rows of the table, one a kind; the recommended one is marked."""
    unit = next(iter(trained.models.values())).unit
    return tuple(
        (
            kind_name(kind) + (" ◂" if kind == trained.chosen else ""),
            amount(one.rms, unit, digits=3),
            amount(one.worst, unit, digits=3),
            percent(one.share),
        )
        for kind, one in trained.residuals.items()
    )


def reasons(trained: Trained) -> str:
    """Return why one is recommended, and what else is to be known."""
    return " ".join(map(spoken, (trained.why, *trained.remarks)))


def kind_name(kind: Kind) -> str:
    """Return what a kind of inverse is called."""
    return spoken(NAMES[kind])


def residual_text(trial: Trial | None, unit: str) -> str:
    """Return what a trial left."""
    if trial is None:
        return "–"
    text = tr("{rms} rms, mean {mean}")
    return text.format(
        rms=amount(trial.rms, unit, digits=3), mean=amount(trial.offset, unit, digits=3)
    )


def owners_text(owners: Mapping[str, str]) -> str | None:
    """Return why the axes cannot be played: someone drives one still."""
    for axis, owner in owners.items():
        text = tr("{owner} still controls axis {axis}; wait, or stop it")
        return text.format(axis=label(axis), owner=spoken(owner))
    return None


def exceedance_text(said: Exceedance) -> str:
    """Return in what an axis went beyond its inverse; empty: in nothing."""
    parts = [tr(words) for flag, words in _SAID.items() if said & flag]
    return tr("The axis has been {where}.").format(where=", ".join(parts)) if parts else ""


def point_text(point: Point, number: int) -> str:
    """Return the figures of a point of the front."""
    own = point.figures
    text = tr(
        "Point {number}: tracking {tracking:.3g} %, settling {settling:.3g} ms, overshoot "
        "{overshoot:.2g} %, Ms {peak:.2f}"
    )
    return text.format(
        number=number,
        tracking=100.0 * own.tracking_rms,
        settling=1e3 * own.settling_s,
        overshoot=100.0 * own.overshoot,
        peak=own.peak_sensitivity,
    )
