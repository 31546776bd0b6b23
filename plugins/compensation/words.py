"""Texts of the compensation panel, without widgets."""

from collections.abc import Mapping

from rotemina.app.language import get_axis_label, translate_message
from rotemina.plugins.compensation import mark, tr
from rotemina.plugins.compensation.trial_motion import CompensationTrial
from rotemina.sim.compensate import KIND_NAMES, InverseExceedance, InverseKind, TrainingResult
from rotemina.sim.tuning import FrontPoint
from rotemina.sim.units import format_percent, format_quantity

INVERSE_HEADINGS = (mark("inverse"), mark("rms"), mark("worst"), mark("of range"))
NO_INVERSE = mark("There is no inverse: train one, or open a file.")
NO_FRONT = mark("there is no front: tune, or open gains")
LIVE_LOOP = mark(
    "The simulated machine closes the loop live at 5 kHz, only if it is also "
    "stable on axes off by 5 %. The boards close no loop: there, only "
    "feed-forward is possible."
)
AT_A_LIMIT = mark(
    "The loop demands more than the range of the axis: move the axis away from the end."
)
SWEEP_TIP = mark(
    "Sweep the whole range of the inverse to erase the history of the axis: this removes most of "
    "a constant error (a loop removes it anyway)"
)
# Texts of the buttons that toggle: while nothing is applied, and while something is.
INVERSE_BUTTON_TEXTS = (mark("Apply"), mark("Remove"))
LOOP_BUTTON_TEXTS = (mark("Apply gains"), mark("Open loop"))
_EXCEEDANCE_TEXTS = {
    InverseExceedance.LOW: mark("below its training range (clamped)"),
    InverseExceedance.HIGH: mark("above its training range (clamped)"),
    InverseExceedance.FAST: mark("faster than in training"),
    InverseExceedance.COMMAND: mark("at an end of the machine's range (clamped)"),
}


def make_residual_rows(trained: TrainingResult) -> tuple[tuple[str, ...], ...]:
    """Return one table row for each kind of inverse. The recommended one is marked."""
    unit = next(iter(trained.models.values())).unit
    return tuple(
        (
            describe_kind(kind) + (" ◂" if kind == trained.recommended_kind else ""),
            format_quantity(residual.rms, unit, digits=3),
            format_quantity(residual.worst, unit, digits=3),
            format_percent(residual.share),
        )
        for kind, residual in trained.residuals.items()
    )


def explain_recommendation(trained: TrainingResult) -> str:
    """Explain why an inverse is recommended, with further remarks."""
    return " ".join(map(translate_message, (trained.recommendation_reason, *trained.remarks)))


def describe_kind(kind: InverseKind) -> str:
    """Return the name of a kind of inverse."""
    return translate_message(KIND_NAMES[kind])


def residual_text(trial: CompensationTrial | None, unit: str) -> str:
    """Return the remaining error of a trial as text."""
    if trial is None:
        return "–"
    text = tr("{rms} rms, mean {mean}")
    return text.format(
        rms=format_quantity(trial.rms, unit, digits=3),
        mean=format_quantity(trial.offset, unit, digits=3),
    )


def describe_owners(owners: Mapping[str, str]) -> str | None:
    """Return who still controls an axis, which prevents a playback. None if nobody does."""
    for axis, owner in owners.items():
        text = tr("{owner} still controls axis {axis}; wait, or stop it")
        return text.format(axis=get_axis_label(axis), owner=translate_message(owner))
    return None


def exceedance_text(exceedance: InverseExceedance) -> str:
    """Return how an axis exceeded the range of its inverse; empty if it did not."""
    parts = [tr(text) for flag, text in _EXCEEDANCE_TEXTS.items() if exceedance & flag]
    return tr("The axis has been {where}.").format(where=", ".join(parts)) if parts else ""


def describe_point(point: FrontPoint, index: int) -> str:
    """Return the performance of a point of the front as text."""
    figures = point.figures
    text = tr(
        "Point {number}: tracking {tracking:.3g} %, settling {settling:.3g} ms, overshoot "
        "{overshoot:.2g} %, Ms {peak:.2f}"
    )
    return text.format(
        number=index,
        tracking=100.0 * figures.tracking_rms,
        settling=1e3 * figures.settling_s,
        overshoot=100.0 * figures.overshoot,
        peak=figures.peak_sensitivity,
    )
