"""What the panel says, and in which numbers; free of widgets."""

import re
from collections.abc import Mapping

from rotemina.app.display import label
from rotemina.app.shell.engine_words import spoken
from rotemina.app.shell.language import marked, translate
from rotemina.plugins.compensation.trial import Trial
from rotemina.sim.compensate.inverse import Exceedance
from rotemina.sim.compensate.judgement import NAMES
from rotemina.sim.compensate.model import Kind
from rotemina.sim.compensate.training import Trained
from rotemina.sim.tuning.front import Point

HEAD = (
    marked("compensation", "inverse"),
    marked("compensation", "rms"),
    marked("compensation", "worst"),
    marked("compensation", "of range"),
)
NOTHING = marked("compensation", "There is no inverse yet: learn one, or open a file.")
NO_FRONT = marked("compensation", "there is no front yet: tune, or open gains")
LIVE_LOOP = marked(
    "compensation",
    "The simulated machine closes the loop live, at 5 kHz; it is put on only where it is stable on "
    "axes off by 5 % too. The boards close none: there, what is put on is feed-forward.",
)
AT_A_LIMIT = marked(
    "compensation", "Its loop asks for more than the axis' range: move it away from the end."
)
SWEEP = marked(
    "compensation",
    "Swing over all that the inverse saw, to wipe out what the axis went through before: takes off "
    "most of a constant error (of a loop it is taken off anyway)",
)
# What the buttons that put on and take off say, each before and after.
SWITCH = (marked("compensation", "Put on"), marked("compensation", "Take off"))
APPLY = (marked("compensation", "Apply point"), marked("compensation", "Take loop off"))
# Kinds of inverses as the model calls them, and why one is recommended.
KINDS = (marked("compensation", "modified Prandtl–Ishlinskii"), marked("compensation", "linear"))
REASONS = (
    marked(
        "compensation",
        "All swings are of one size, so that richer kinds would guess at other sizes: train on "
        "swings that grow or fade",
    ),
    marked("compensation", "It is the simplest of those within 2% of the least"),
)
# What a training does.
STAGES = (
    marked("compensation", "lag and creep"),
    marked("compensation", "plays"),
    marked("compensation", "done"),
)
WHY = re.compile(
    r"(?P<kind>.+?) leaves (?P<share>\S+) of the range on rows that no inverse was trained on; "
    r"(?P<others>.*?)(\.( (?P<more>.*))?)?",
    re.DOTALL,
)
_EPOCH = re.compile(r"ANFIS, epoch (?P<epoch>\d+): (?P<error>\S+) unseen")
_SAID = {
    Exceedance.LOW: marked("compensation", "below what it saw (clamped)"),
    Exceedance.HIGH: marked("compensation", "above what it saw (clamped)"),
    Exceedance.FAST: marked("compensation", "faster than it saw"),
    Exceedance.COMMAND: marked("compensation", "at an end of the machine's range (clamped)"),
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
            kind_name(kind) + (" ◂" if kind == trained.chosen else ""),
            micro(one.rms, unit),
            micro(one.worst, unit),
            f"{one.share:.2%}",
        )
        for kind, one in trained.residuals.items()
    )


def reasons(trained: Trained) -> str:
    """Return why one is recommended, and what else is to be known."""
    return " ".join([f"{_why(trained.why)}.", *trained.remarks])


def kind_name(kind: Kind) -> str:
    """Return what a kind of inverse is called."""
    return translate("compensation", NAMES[kind])


def stage(what: str) -> str:
    """Return what a training does now."""
    epoch = _EPOCH.fullmatch(what)
    if epoch is None:
        return translate("compensation", what) if what else ""
    return translate("compensation", "ANFIS, epoch {epoch}: {error} unseen").format(
        **epoch.groupdict()
    )


def residual_text(trial: Trial | None, unit: str) -> str:
    """Return what a trial left."""
    if trial is None:
        return "–"
    text = translate("compensation", "{rms} rms, mean {mean}")
    return text.format(rms=micro(trial.rms, unit), mean=micro(trial.offset, unit))


def owners_text(owners: Mapping[str, str]) -> str | None:
    """Return why the axes cannot be played: somebody drives one still."""
    for axis, owner in owners.items():
        text = translate("compensation", "axis {axis} is still driven by {owner}; wait, or stop it")
        return text.format(axis=label(axis), owner=spoken(owner))
    return None


def exceedance_text(said: Exceedance) -> str:
    """Return in what an axis went beyond its inverse; empty: in nothing."""
    parts = [translate("compensation", words) for flag, words in _SAID.items() if said & flag]
    text = translate("compensation", "It has been {where}.")
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


def _why(told: str) -> str:
    """Return the model's reason in the language of the window."""
    found = WHY.fullmatch(told)
    if found is None:
        return told
    others = (one.rpartition(" ") for one in found["others"].split(", "))
    text = translate(
        "compensation",
        "{inverse} leaves {share} of the range on rows that no inverse was trained on; {others}",
    ).format(
        inverse=translate("compensation", found["kind"]),
        share=found["share"],
        others=", ".join(
            " ".join((translate("compensation", name), share)) for name, _, share in others
        ),
    )
    if not found["more"]:
        return text
    more = translate("compensation", found["more"])
    return f"{text}. {more}"
