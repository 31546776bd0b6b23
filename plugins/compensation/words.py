"""What the panel says, and in which numbers; free of Qt."""

from collections.abc import Mapping

from rotemina.app.display import label
from rotemina.plugins.compensation.trial import Trial
from rotemina.sim.compensate.inverse import Beyond
from rotemina.sim.compensate.judgement import NAMES
from rotemina.sim.compensate.training import Trained
from rotemina.sim.tuning.front import Point

HEAD = ("inverse", "rms", "worst", "of range")
NOTHING = "There is no inverse yet: learn one, or open a file."
NO_FRONT = "there is no front yet: tune, or open gains"
LIVE_LOOP = (
    "The simulated machine closes the loop live, at 5 kHz; it is put on only where it is stable on "
    "axes off by 5 % too. The boards close none: there, what is put on is feed-forward."
)
AT_A_LIMIT = "Its loop asks for more than the axis' range: move it away from the end."
SWEEP = (
    "Swing over all that the inverse saw, to wipe out what the axis went through before: takes off "
    "most of a constant error (of a loop it is taken off anyway)"
)
_SAID = {
    Beyond.LOW: "below what it saw (clamped)",
    Beyond.HIGH: "above what it saw (clamped)",
    Beyond.FAST: "faster than it saw",
    Beyond.COMMAND: "at an end of the machine's range (clamped)",
}


def micro(value: float, unit: str) -> str:
    """Return a length or angle in µm or µrad, or in n where it is small."""
    if abs(value) < 0.9995e-7:
        return f"{value * 1e9:.3g} n{unit}"
    return f"{value * 1e6:.3g} µ{unit}"


def judged(trained: Trained) -> tuple[tuple[str, ...], ...]:
    """Return the rows of the table, one a kind; the recommended one is marked."""
    unit = next(iter(trained.models.values())).unit
    return tuple(
        (
            NAMES[kind] + (" ◂" if kind == trained.chosen else ""),
            micro(one.rms, unit),
            micro(one.worst, unit),
            f"{one.share:.2%}",
        )
        for kind, one in trained.residuals.items()
    )


def reasons(trained: Trained) -> str:
    """Return why one is recommended, and what else is to be known."""
    return " ".join([f"{trained.why}.", *trained.remarks])


def left(trial: Trial | None, unit: str) -> str:
    """Return what a trial left."""
    if trial is None:
        return "–"
    return f"{micro(trial.rms, unit)} rms, mean {micro(trial.offset, unit)}"


def owned(owners: Mapping[str, str]) -> str | None:
    """Return why the axes cannot be played: somebody drives one still."""
    for axis, owner in owners.items():
        return f"axis {label(axis)} is still driven by {owner}; wait, or stop it"
    return None


def beyond(said: Beyond) -> str:
    """Return in what an axis went beyond its inverse; empty: in nothing."""
    parts = [words for flag, words in _SAID.items() if said & flag]
    return f"It has been {', '.join(parts)}." if parts else ""


def point_text(point: Point, number: int) -> str:
    """Return the figures of a point of the front."""
    own = point.figures
    return (
        f"Point {number}: tracking {100.0 * own.tracking_rms:.3g} %, settling "
        f"{1e3 * own.settling_s:.3g} ms, overshoot {100.0 * own.overshoot:.2g} %, Ms "
        f"{own.peak_sensitivity:.2f}"
    )
