"""How the camera is doing, in words over the picture. Free of Qt."""

from dataclasses import dataclass

from rotemina.app.cameras.feed import FeedState, FeedView
from rotemina.app.microscope.sight import Activity, Sight, TipState
from rotemina.app.motion.state import SessionState
from rotemina.drivers.samples import DeviceState

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
    FeedState.CLOSED: "No camera",
    FeedState.OPENING: "Opening …",
    FeedState.WAITING: "Waiting for a trigger",
    FeedState.STALLED: "STALLED",
    FeedState.FROZEN: "FROZEN",
    FeedState.BLACK: "BLACK",
    FeedState.LOST: "LOST",
}


@dataclass(frozen=True, slots=True)
class Standing:
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


def standing(view: FeedView) -> Standing:
    """Return what is to be said of a camera's moment."""
    state, tone = view.state, TONES[view.state]
    if state is FeedState.LIVE and view.frame is None:
        return Standing("busy", "opened", "Waiting for the first picture")
    if state is FeedState.LIVE:
        # One picture has no rate yet.
        parts = ["live", *([f"{view.rate_hz:.0f} Hz"] if view.rate_hz > 0.0 else [])]
        return Standing(tone, " · ".join((*parts, age(view.age_s))))
    badge = f"{state.value} · {age(view.age_s)}" if view.frame is not None else state.value
    if state is FeedState.WAITING:
        title = "" if view.frame is not None else TITLES[state]
        return Standing(tone, badge, title)
    reason = view.reason
    if state is FeedState.CLOSED:
        reason = "Choose a camera under Tools, Camera, and open it."
    return Standing(tone, badge, TITLES[state], reason, veiled=state is not FeedState.OPENING)


def age(age_s: float | None) -> str:
    """Return an age as text, which does not flicker below a tenth of a second."""
    if age_s is None:
        return "–"
    return f"{1e3 * age_s:.0f} ms old" if age_s < 1.0 else f"{age_s:.1f} s old"


def against_aiming(sight: Sight) -> str | None:
    """Return why a place in the picture is no place to go to; None if it is."""
    if sight.feed.state is not FeedState.LIVE or sight.feed.frame is None:
        return f"the picture is not live: {sight.feed.state.value}"
    if sight.calibration is None:
        return sight.calibration_problem or "this camera and objective are not calibrated yet"
    return None


def against_clicking(sight: Sight, state: SessionState) -> str | None:
    """Return why no click may move anything now; None if it may."""
    why = against_aiming(sight) or against_moving(sight, state)
    if why is None and sight.tip.state is not TipState.TRACKED:
        why = "the tip is not tracked; click it with Tip, or switch tracking on under Vision"
    return why


def against_moving(sight: Sight, state: SessionState) -> str | None:
    """Return why nothing may be moved by the picture now; None if it may."""
    if sight.feed.state is not FeedState.LIVE or sight.feed.frame is None:
        return f"the picture is not live: {sight.feed.state.value}"
    if sight.activity is not Activity.NONE:
        return f"{sight.activity.value} is under way"
    if state.locked is not None:
        return f"motion is locked: {state.locked}"
    if state.activity is not DeviceState.IDLE:
        return "the machine is not at rest"
    return None
