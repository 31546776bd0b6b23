"""Text and numbers of the panel; free of widgets."""

from collections.abc import Mapping

from rotemina.app.display_units import label
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import marked, translate
from rotemina.plugins.compensation.trial_motion import Trial
from rotemina.sim.compensate.inverse import Exceedance
from rotemina.sim.compensate.inverse_parameters import Kind
from rotemina.sim.compensate.judgement import NAMES
from rotemina.sim.compensate.training import Trained
from rotemina.sim.quantities import amount, percent
from rotemina.sim.tuning.pareto_front import Point

HEAD = (
    marked("compensation", "inverse"),
    marked("compensation", "rms"),
    marked("compensation", "worst"),
    marked("compensation", "of range"),
)
NOTHING = marked("compensation", "There is no inverse: train one, or open a file.")
NO_FRONT = marked("compensation", "there is no front: tune, or open gains")
LIVE_LOOP = marked(
    "compensation",
    "The simulated machine closes the loop live at 5 kHz, only if it is also "
    "stable on axes off by 5 %. The boards close no loop: there, only "
    "feedforward is possible.",
)
AT_A_LIMIT = marked(
    "compensation",
    "The loop demands more than the range of the axis: move the axis away from the end.",
)
SWEEP = marked(
    "compensation",
    "Sweep the whole range of the inverse to erase the history of the axis: this removes most of "
    "a constant error (a loop removes it anyway)",
)
# What the buttons that put on and take off say, each before and after.
SWITCH = (marked("compensation", "Apply"), marked("compensation", "Remove"))
APPLY = (marked("compensation", "Apply gains"), marked("compensation", "Open loop"))
_SAID = {
    Exceedance.LOW: marked("compensation", "below its training range (clamped)"),
    Exceedance.HIGH: marked("compensation", "above its training range (clamped)"),
    Exceedance.FAST: marked("compensation", "faster than in training"),
    Exceedance.COMMAND: marked("compensation", "at an end of the machine's range (clamped)"),
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
    text = translate("compensation", "{rms} rms, mean {mean}")
    return text.format(
        rms=amount(trial.rms, unit, digits=3), mean=amount(trial.offset, unit, digits=3)
    )


def owners_text(owners: Mapping[str, str]) -> str | None:
    """Return why the axes cannot be played: someone drives one still."""
    for axis, owner in owners.items():
        text = translate("compensation", "{owner} still controls axis {axis}; wait, or stop it")
        return text.format(axis=label(axis), owner=spoken(owner))
    return None


def exceedance_text(said: Exceedance) -> str:
    """Return in what an axis went beyond its inverse; empty: in nothing."""
    parts = [translate("compensation", words) for flag, words in _SAID.items() if said & flag]
    text = translate("compensation", "The axis has been {where}.")
    return text.format(where=", ".join(parts)) if parts else ""


def point_text(point: Point, number: int) -> str:
    """Return the figures of a point of the front."""
    own = point.figures
    text = translate(
        "compensation",
        "Point {number}: tracking {tracking:.3g} %, settling {settling:.3g} ms, overshoot "
        "{overshoot:.2g} %, Ms {peak:.2f}",
    )
    return text.format(
        number=number,
        tracking=100.0 * own.tracking_rms,
        settling=1e3 * own.settling_s,
        overshoot=100.0 * own.overshoot,
        peak=own.peak_sensitivity,
    )
