"""Texts about a penetration, and labels of its two buttons in each phase."""

from enum import StrEnum

from rotemina.app.language import translate_message
from rotemina.app.motion.penetration import (
    RUNNING_PHASES,
    PenetrationPhase,
    PenetrationStatus,
    PenetrationVerdict,
)
from rotemina.app.motion.state import SessionState
from rotemina.plugins.penetration import mark, tr
from rotemina.plugins.penetration.plan_preview import format_distance, format_speed

#: The phases shown in the bar, in their order.
STRIP_PHASES = (
    PenetrationPhase.APPROACH,
    PenetrationPhase.CONTACT,
    PenetrationPhase.THRUST,
    PenetrationPhase.HOLD,
    PenetrationPhase.INJECT,
    PenetrationPhase.RETRACT,
)
#: A second press within this time is ignored. An alarmed operator may press twice, and the second
#: press must neither stop nor start a retraction.
MIN_PRESS_INTERVAL_S = 0.5
#: Phases in which the parameters belong to a run and cannot be changed.
LOCKED_PHASES = RUNNING_PHASES | {PenetrationPhase.ARMED, PenetrationPhase.HELD}

_PHASE_SENTENCES = {
    PenetrationPhase.APPROACH: mark("The tip approaches until it touches the membrane."),
    PenetrationPhase.CONTACT: mark("Contact. The tip rests on the membrane; the thrust follows."),
    PenetrationPhase.THRUST: mark("The device executes the thrust."),
    PenetrationPhase.HOLD: mark("The tip holds at its depth."),
    PenetrationPhase.INJECT: mark("The tool is on."),
    PenetrationPhase.HOLD_AFTER: mark("The tool is off; the tip holds at its depth."),
    PenetrationPhase.RETRACT: mark("The tip returns to its start."),
}
# Keys and texts are English here, and are translated where they are displayed.
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


class PhaseLight(StrEnum):
    """Light of a phase in the bar."""

    OFF = "off"
    PASSED = "passed"
    PRESENT = "present"
    HELD = "held"


def find_button_text(phase: PenetrationPhase) -> str:
    """Return the English label of the main button in a phase."""
    if phase is PenetrationPhase.RETRACT:
        return "Hold"
    if phase is PenetrationPhase.HELD:
        return "Retract"
    return "Stop and retract" if phase in RUNNING_PHASES else "Start"


def find_button_tip(phase: PenetrationPhase) -> str:
    """Return the English tooltip of the main button in a phase."""
    return _BUTTON_TIPS[find_button_text(phase)]


def find_button_objection(status: PenetrationStatus, state: SessionState) -> str | None:
    """Return why the main button cannot act now, or None if it can."""
    if status.phase is PenetrationPhase.HELD:
        return state.lock_reason
    return (
        None if status.phase in LOCKED_PHASES else tr("the penetration is not armed; arm it first")
    )


def is_press_valid(
    shown_phase: PenetrationPhase, phase: PenetrationPhase, since_press_s: float
) -> bool:
    """Return whether a press on the main button acts.

    The label must still be right, and the press must not be the second of a double press. A press
    that stops a run always acts.
    """
    if find_button_text(shown_phase) != find_button_text(phase):
        return False
    return find_button_text(phase) == "Stop and retract" or since_press_s >= MIN_PRESS_INTERVAL_S


def find_arm_text(phase: PenetrationPhase) -> str:
    """Return the English label of the arm button in a phase."""
    return {PenetrationPhase.ARMED: "Disarm", PenetrationPhase.HELD: "Free the axes"}.get(
        phase, "Arm"
    )


def find_arm_tip(phase: PenetrationPhase) -> str:
    """Return the English tooltip of the arm button in a phase."""
    return _ARM_TIPS[find_arm_text(phase)]


def find_lights(status: PenetrationStatus) -> tuple[PhaseLight, ...]:
    """Return the light of each phase in the bar."""
    phase = status.phase
    if phase in RUNNING_PHASES:
        current_phase = PenetrationPhase.HOLD if phase is PenetrationPhase.HOLD_AFTER else phase
        return tuple(
            PhaseLight.PRESENT if strip_phase is current_phase else PhaseLight.OFF
            for strip_phase in STRIP_PHASES
        )
    run = status.run
    if run is None or phase in (PenetrationPhase.DISARMED, PenetrationPhase.ARMED):
        return (PhaseLight.OFF,) * len(STRIP_PHASES)
    passed_phases = [name for name, _ in run.phases]
    last_phase = next(
        (name for name in reversed(passed_phases) if name != str(PenetrationPhase.HELD)), ""
    )
    if last_phase == str(PenetrationPhase.HOLD_AFTER):
        last_phase = str(PenetrationPhase.HOLD)
    lights = []
    for strip_phase in STRIP_PHASES:
        light = PhaseLight.PASSED if str(strip_phase) in passed_phases else PhaseLight.OFF
        lights.append(
            PhaseLight.HELD
            if phase is PenetrationPhase.HELD and str(strip_phase) == last_phase
            else light
        )
    return tuple(lights)


def format_headline(status: PenetrationStatus) -> str:
    """Return the phase in a word or two. If armed, add the remaining time."""
    if status.phase is PenetrationPhase.ARMED and status.armed_remaining_s is not None:
        return tr("armed, {left_s:.0f} s").format(left_s=status.armed_remaining_s)
    return translate_message(status.phase)


def describe_status(status: PenetrationStatus, arming_objection: str | None) -> str:
    """Return the running phase, or the latest outcome and whether arming is possible."""
    phase = status.phase
    if phase in RUNNING_PHASES:
        return tr(_PHASE_SENTENCES[phase]) + (
            tr(" Reason: {reason}.").format(reason=translate_message(status.reason))
            if status.reason
            else ""
        )
    if phase is PenetrationPhase.HELD:
        return tr(
            "Held: {reason}. The tip stays in place; press Retract to return it, or "
            "Free the axes to move it manually."
        ).format(reason=translate_message(status.reason))
    if phase is PenetrationPhase.ARMED:
        return tr("Armed: all axes are reserved. Nothing moves until you press Start.")
    outcome = _describe_outcome(status)
    readiness = (
        tr("Ready to arm.")
        if arming_objection is None
        else tr("Cannot be armed now: {why_not}").format(
            why_not=_end_with_full_stop(translate_message(arming_objection))
        )
    )
    return f"{outcome} {readiness}".lstrip()


def _describe_outcome(status: PenetrationStatus) -> str:
    run = status.run
    if status.phase is PenetrationPhase.DISARMED or run is None:
        return (
            tr("Disarmed: {reason}").format(
                reason=_end_with_full_stop(translate_message(status.reason))
            )
            if status.reason
            else ""
        )
    if run.verdict is PenetrationVerdict.DONE and run.thrust is not None:
        thrust = run.thrust
        return tr(
            "Done: depth {depth}, maximum speed {speed}, error {error} from the profile."
        ).format(
            depth=format_distance(thrust.depth),
            speed=format_speed(thrust.peak_speed),
            error=format_distance(thrust.error),
        )
    verdict = translate_message(run.verdict)
    return tr("{verdict}: {reason} The tip is retracted.").format(
        verdict=verdict[:1].upper() + verdict[1:],
        reason=_end_with_full_stop(translate_message(run.reason)),
    )


def _end_with_full_stop(sentence: str) -> str:
    translated = translate_message(sentence)
    return translated if translated.endswith(".") else f"{translated}."
