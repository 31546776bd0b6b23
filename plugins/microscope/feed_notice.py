"""Text over the picture about the state of the camera, and objections to moves."""

from dataclasses import dataclass

from rotemina.app.cameras import FeedState, FeedView
from rotemina.app.language import translate_message
from rotemina.app.microscope import (
    MicroscopeActivity,
    MicroscopeStatus,
    TipState,
)
from rotemina.app.motion.state import SessionState
from rotemina.drivers.contract import DeviceState
from rotemina.plugins.microscope import mark, tr
from rotemina.sim.messages import format_fixed

STATE_TONES = {
    FeedState.CLOSED: "quiet",
    FeedState.OPENING: "busy",
    FeedState.LIVE: "good",
    FeedState.WAITING: "busy",
    FeedState.STALLED: "danger",
    FeedState.FROZEN: "danger",
    FeedState.BLACK: "warning",
    FeedState.LOST: "danger",
}
STATE_TITLES = {
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
    """Text over the picture.

    Attributes
    ----------
    tone : str
        Colour role of the theme: good, busy, quiet, warning or danger.
    badge : str
        Text in the corner: state, rate and age.
    title, reason : str
        Text in the middle of the picture; empty if the picture is usable.
    veiled : bool
        Whether the picture is outdated. It is then greyed and hatched, and no move may use it.
    """

    tone: str
    badge: str
    title: str = ""
    reason: str = ""
    veiled: bool = False


def make_feed_notice(view: FeedView) -> FeedNotice:
    """Return the notice for the current state of a camera."""
    state, tone = view.state, STATE_TONES[view.state]
    if state is FeedState.LIVE and view.frame is None:
        return FeedNotice("busy", tr("opened"), tr("Waiting for the first picture"))
    if state is FeedState.LIVE:
        # The rate is known only after two pictures.
        parts = [
            tr("live"),
            *([f"{format_fixed(view.rate_hz, 0)} Hz"] if view.rate_hz > 0.0 else []),
        ]
        lost = [tr("{lost} lost").format(lost=view.frame.lost)] if view.frame.lost else []
        return FeedNotice(tone, " · ".join((*parts, format_age(view.age_s), *lost)))
    badge = translate_message(state)
    if view.frame is not None:
        badge = f"{badge} · {format_age(view.age_s)}"
    if state is FeedState.WAITING:
        title = "" if view.frame is not None else tr(STATE_TITLES[state])
        return FeedNotice(tone, badge, title)
    reason = translate_message(view.reason)
    if state is FeedState.CLOSED:
        reason = tr("Choose a camera under Tools, Camera, and open it.")
    title = tr(STATE_TITLES[state])
    return FeedNotice(tone, badge, title, reason, veiled=state is not FeedState.OPENING)


def format_age(age_s: float | None) -> str:
    """Return an age as text: in ms below one second, else in s."""
    if age_s is None:
        return "–"
    return (
        tr("{ms:.0f} ms old").format(ms=1e3 * age_s)
        if age_s < 1.0
        else tr("{s:.1f} s old").format(s=age_s)
    )


def find_aiming_objection(status: MicroscopeStatus) -> str | None:
    """Return why a point of the picture cannot be a target, or None if it can."""
    if status.feed.state is not FeedState.LIVE or status.feed.frame is None:
        return tr("the picture is not live: {state}").format(
            state=translate_message(status.feed.state)
        )
    if status.calibration is None:
        return status.calibration_problem or tr("this camera and objective are not calibrated")
    return None


def find_click_objection(status: MicroscopeStatus, state: SessionState) -> str | None:
    """Return why a click cannot move the tip now, or None if it can."""
    objection = find_aiming_objection(status) or find_motion_objection(status, state)
    if objection is None and status.tip.state is not TipState.TRACKED:
        objection = tr(
            "the tip is not tracked; click it with Tip, or turn on tracking under Vision"
        )
    return objection


def find_motion_objection(status: MicroscopeStatus, state: SessionState) -> str | None:
    """Return why a move cannot rely on the picture now, or None if it can."""
    if status.feed.state is not FeedState.LIVE or status.feed.frame is None:
        return tr("the picture is not live: {state}").format(
            state=translate_message(status.feed.state)
        )
    if status.activity is not MicroscopeActivity.NONE:
        return tr("{activity} is running").format(activity=translate_message(status.activity))
    if state.lock_reason is not None:
        return tr("motion is locked: {locked}").format(locked=translate_message(state.lock_reason))
    if state.activity is not DeviceState.IDLE:
        return tr("the machine is not at rest")
    return None
