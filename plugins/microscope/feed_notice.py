"""The state of the camera as text over the picture."""

from dataclasses import dataclass

from rotemina.app.cameras.feed import FeedState, FeedView
from rotemina.app.microscope.status import Activity, MicroscopeStatus, TipState
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.drivers.samples import DeviceState
from rotemina.plugins.microscope import mark, tr
from rotemina.sim.quantities import fixed

TONES = {
    FeedState.CLOSED: "quiet",
    FeedState.OPENING: "busy",
    FeedState.LIVE: "good",
    FeedState.WAITING: "busy",
    FeedState.STALLED: "danger",
    FeedState.FROZEN: "danger",
    FeedState.BLACK: "warning",
    FeedState.LOST: "danger",
}
TITLES = {
    FeedState.CLOSED: mark("No camera"),
    FeedState.OPENING: mark("Opening …"),
    FeedState.WAITING: mark("Waiting for a trigger"),
    FeedState.STALLED: mark("STALLED"),
    FeedState.FROZEN: mark("FROZEN"),
    FeedState.BLACK: mark("BLACK"),
    FeedState.LOST: mark("LOST"),
}


@dataclass(frozen=True, slots=True)
class FeedNotice:
    """What is said of the picture.

    Attributes
    ----------
    tone : str
        Of the theme: good, busy, quiet, warning, danger.
    badge : str
        In a corner: state, rate, age.
    title, reason : str
        Over the picture; empty where nothing stands in the way.
    veiled : bool
        The picture shows the past: it is greyed and hatched, and nothing is moved by it.
    """

    tone: str
    badge: str
    title: str = ""
    reason: str = ""
    veiled: bool = False


def feed_notice(view: FeedView) -> FeedNotice:
    """Return the text for the present state of a camera."""
    state, tone = view.state, TONES[view.state]
    if state is FeedState.LIVE and view.frame is None:
        return FeedNotice("busy", tr("opened"), tr("Waiting for the first picture"))
    if state is FeedState.LIVE:
        # One picture has no rate yet.
        parts = [tr("live"), *([f"{fixed(view.rate_hz, 0)} Hz"] if view.rate_hz > 0.0 else [])]
        lost = [tr("{lost} lost").format(lost=view.frame.lost)] if view.frame.lost else []
        return FeedNotice(tone, " · ".join((*parts, age(view.age_s), *lost)))
    badge = spoken(state)
    if view.frame is not None:
        badge = f"{badge} · {age(view.age_s)}"
    if state is FeedState.WAITING:
        title = "" if view.frame is not None else tr(TITLES[state])
        return FeedNotice(tone, badge, title)
    reason = spoken(view.reason)
    if state is FeedState.CLOSED:
        reason = tr("Choose a camera under Tools, Camera, and open it.")
    title = tr(TITLES[state])
    return FeedNotice(tone, badge, title, reason, veiled=state is not FeedState.OPENING)


def age(age_s: float | None) -> str:
    """Return an age as text, which does not flicker below a tenth of a second."""
    if age_s is None:
        return "–"
    return (
        tr("{ms:.0f} ms old").format(ms=1e3 * age_s)
        if age_s < 1.0
        else tr("{s:.1f} s old").format(s=age_s)
    )


def against_aiming(status: MicroscopeStatus) -> str | None:
    """Return why a place in the picture is no place to go to; None if it is."""
    if status.feed.state is not FeedState.LIVE or status.feed.frame is None:
        return tr("the picture is not live: {state}").format(state=spoken(status.feed.state))
    if status.calibration is None:
        return status.calibration_problem or tr("this camera and objective are not calibrated")
    return None


def against_clicking(status: MicroscopeStatus, state: SessionState) -> str | None:
    """Return why no click may move anything now; None if it may."""
    why = against_aiming(status) or against_moving(status, state)
    if why is None and status.tip.state is not TipState.TRACKED:
        why = tr("the tip is not tracked; click it with Tip, or turn on tracking under Vision")
    return why


def against_moving(status: MicroscopeStatus, state: SessionState) -> str | None:
    """Return why nothing may be moved by the picture now; None if it may."""
    if status.feed.state is not FeedState.LIVE or status.feed.frame is None:
        return tr("the picture is not live: {state}").format(state=spoken(status.feed.state))
    if status.activity is not Activity.NONE:
        return tr("{activity} is running").format(activity=spoken(status.activity))
    if state.locked is not None:
        return tr("motion is locked: {locked}").format(locked=spoken(state.locked))
    if state.activity is not DeviceState.IDLE:
        return tr("the machine is not at rest")
    return None
