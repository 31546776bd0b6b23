"""Text about a penetration, and the present function of its two buttons."""

from enum import StrEnum

from rotemina.app.motion.penetration.run_log import Verdict
from rotemina.app.motion.penetration.status import UNDER_WAY, PenetrationStatus, Phase
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.engine_words import spoken
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.plan_preview import speed_text, way_text

#: The phases of the strip, in their order.
STRIP = (Phase.APPROACH, Phase.CONTACT, Phase.THRUST, Phase.HOLD, Phase.INJECT, Phase.RETRACT)
SETTLE_S = 0.5  # a second press in alarm must not stop the way back, nor begin one
#: Phases in which the parameters are those of a run.
FIXED = UNDER_WAY | {Phase.ARMED, Phase.HELD}

_DOING = {
    Phase.APPROACH: mark("The tip approaches until it touches the membrane."),
    Phase.CONTACT: mark("Contact. The tip rests on the membrane; the thrust follows."),
    Phase.THRUST: mark("The device executes the thrust."),
    Phase.HOLD: mark("The tip holds at its depth."),
    Phase.INJECT: mark("The tool is on."),
    Phase.HOLD_AFTER: mark("The tool is off; the tip holds at its depth."),
    Phase.RETRACT: mark("The tip returns to its start."),
}
# What the buttons do, in English here: translated where it is shown.
_BUTTON_TIPS = {
    mark("Hold"): mark("Stop the retraction; the tip stays in place"),
    mark("Retract"): mark("Return the tip to the start of the run"),
    mark("Stop and retract"): mark("Stop, switch the tool off, and retract the tip along its axis"),
    mark("Start"): mark("Start the approach to the cell"),
}
_ARM_TIPS = {
    mark("Arm"): mark("Check all conditions and reserve all axes; nothing moves before Start"),
    mark("Disarm"): mark("Release the axes; nothing has moved"),
    mark("Free the axes"): mark("Leave the tip in place and release the axes for manual motion"),
}


class Light(StrEnum):
    """How a phase of the strip is lit."""

    OFF = "off"
    PASSED = "passed"
    PRESENT = "present"
    HELD = "held"


def button_word(phase: Phase) -> str:
    """Return what the one button does in a phase."""
    if phase is Phase.RETRACT:
        return "Hold"
    if phase is Phase.HELD:
        return "Retract"
    return "Stop and retract" if phase in UNDER_WAY else "Start"


def button_tip(phase: Phase) -> str:
    """Return what that means."""
    return _BUTTON_TIPS[button_word(phase)]


def against_button(status: PenetrationStatus, state: SessionState) -> str | None:
    """Return why the button cannot act now; None: it can."""
    if status.phase is Phase.HELD:
        return state.locked
    return None if status.phase in FIXED else tr("the penetration is not armed; arm it first")


def counts(shown: Phase, now: Phase, since_press_s: float) -> bool:
    """Whether a press on the button is to act: as it was labelled, and not by a second click.

    What stops a run always acts.
    """
    if button_word(shown) != button_word(now):
        return False
    return button_word(now) == "Stop and retract" or since_press_s >= SETTLE_S


def arm_word(phase: Phase) -> str:
    """Return what the other button does in a phase."""
    return {Phase.ARMED: "Disarm", Phase.HELD: "Free the axes"}.get(phase, "Arm")


def arm_tip(phase: Phase) -> str:
    """Return what that means."""
    return _ARM_TIPS[arm_word(phase)]


def lights(status: PenetrationStatus) -> tuple[Light, ...]:
    """Return how each phase of the strip is lit."""
    phase = status.phase
    if phase in UNDER_WAY:
        present = Phase.HOLD if phase is Phase.HOLD_AFTER else phase
        return tuple(Light.PRESENT if one is present else Light.OFF for one in STRIP)
    run = status.run
    if run is None or phase in (Phase.DISARMED, Phase.ARMED):
        return (Light.OFF,) * len(STRIP)
    passed = [name for name, _ in run.phases]
    last = next((one for one in reversed(passed) if one != str(Phase.HELD)), "")
    last = str(Phase.HOLD) if last == str(Phase.HOLD_AFTER) else last
    found = []
    for one in STRIP:
        light = Light.PASSED if str(one) in passed else Light.OFF
        found.append(Light.HELD if phase is Phase.HELD and str(one) == last else light)
    return tuple(found)


def headline(status: PenetrationStatus) -> str:
    """Return the phase in a word or two, with the time that is left when armed."""
    if status.phase is Phase.ARMED and status.armed_left_s is not None:
        return tr("armed, {left_s:.0f} s").format(left_s=status.armed_left_s)
    return spoken(status.phase)


def message(status: PenetrationStatus, why_not: str | None) -> str:
    """Return the running phase, or the latest outcome and whether arming is possible."""
    phase = status.phase
    if phase in UNDER_WAY:
        return tr(_DOING[phase]) + (
            tr(" Why: {reason}.").format(reason=spoken(status.reason)) if status.reason else ""
        )
    if phase is Phase.HELD:
        return tr(
            "Held: {reason}. The tip stays in place; press Retract to return it, or "
            "Free the axes to move it manually."
        ).format(reason=spoken(status.reason))
    if phase is Phase.ARMED:
        return tr("Armed: all axes are reserved. Nothing moves until you press Start.")
    came = _came_of(status)
    may = (
        tr("Ready to arm.")
        if why_not is None
        else tr("Cannot be armed now: {why_not}").format(why_not=_stopped(spoken(why_not)))
    )
    return f"{came} {may}".lstrip()


def _came_of(status: PenetrationStatus) -> str:
    run = status.run
    if status.phase is Phase.DISARMED or run is None:
        return (
            tr("Disarmed: {reason}").format(reason=_stopped(spoken(status.reason)))
            if status.reason
            else ""
        )
    if run.verdict is Verdict.DONE and run.thrust is not None:
        thrust = run.thrust
        return tr(
            "Done: depth {depth}, maximum speed {speed}, error {error} from the profile."
        ).format(
            depth=way_text(thrust.depth),
            speed=speed_text(thrust.peak_speed),
            error=way_text(thrust.error),
        )
    verdict = spoken(run.verdict)
    return tr("{verdict}: {reason} The tip is retracted.").format(
        verdict=verdict[:1].upper() + verdict[1:], reason=_stopped(spoken(run.reason))
    )


def _stopped(sentence: str) -> str:
    said = spoken(sentence)
    return said if said.endswith(".") else f"{said}."
