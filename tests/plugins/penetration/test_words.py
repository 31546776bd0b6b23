"""Labels of the buttons and texts of the status in each phase."""

from dataclasses import replace

import pytest

from rotemina.app.motion.penetration import (
    RUNNING_PHASES,
    PenetrationPhase,
    PenetrationRun,
    PenetrationStatus,
    PenetrationVerdict,
)
from rotemina.app.motion.penetration.thrust import MeasuredThrust
from rotemina.app.motion.state import SessionState
from rotemina.plugins.penetration import describe_status, format_headline
from rotemina.plugins.penetration.words import (
    LOCKED_PHASES,
    MIN_PRESS_INTERVAL_S,
    STRIP_PHASES,
    PhaseLight,
    find_arm_text,
    find_button_objection,
    find_button_text,
    find_lights,
    is_press_valid,
)

RUN = PenetrationRun(
    started="2026-11-21T10:00:00+00:00",
    robot="RoTeMiNa",
    driver="simulator",
    parameters={},
    verdict=PenetrationVerdict.DONE,
    reason="",
    phases=tuple(
        (name, float(time_s))
        for time_s, name in enumerate(
            ("approach", "contact", "thrust", "hold", "hold after", "retract", "done")
        )
    ),
    thrust=MeasuredThrust(4.95e-5, 3e-7, 2e-3, 5.5e-4, 8.1e-4, 1000.0),
)


@pytest.mark.parametrize("phase", PenetrationPhase)
def test_the_button_label_names_the_action_of_a_press(phase):
    special_labels = {PenetrationPhase.RETRACT: "Hold", PenetrationPhase.HELD: "Retract"}
    default_label = "Stop and retract" if phase in RUNNING_PHASES else "Start"
    assert find_button_text(phase) == special_labels.get(phase, default_label)
    special_arm_labels = {PenetrationPhase.ARMED: "Disarm", PenetrationPhase.HELD: "Free the axes"}
    assert find_arm_text(phase) == special_arm_labels.get(phase, "Arm")
    status = PenetrationStatus(phase)
    assert (find_button_objection(status, SessionState()) is None) == (
        phase in LOCKED_PHASES
        and (phase is not PenetrationPhase.HELD or SessionState().lock_reason is None)
    )


def test_the_button_of_a_locked_held_tip_is_disabled_with_the_reason():
    status = PenetrationStatus(PenetrationPhase.HELD)
    assert (
        find_button_objection(status, SessionState(lock_reason="it is latched")) == "it is latched"
    )
    assert find_button_objection(status, SessionState(lock_reason=None)) is None


def test_a_press_counts_only_if_it_still_does_what_its_label_said():
    # The label was "Stop and retract", but the tip already retracts: the press must not hold it.
    assert not is_press_valid(PenetrationPhase.HOLD, PenetrationPhase.RETRACT, 10.0)
    assert is_press_valid(PenetrationPhase.APPROACH, PenetrationPhase.CONTACT, 0.0)
    # A hasty second click neither halts a retraction nor starts one.
    assert not is_press_valid(
        PenetrationPhase.RETRACT, PenetrationPhase.RETRACT, 0.9 * MIN_PRESS_INTERVAL_S
    )
    assert not is_press_valid(
        PenetrationPhase.HELD, PenetrationPhase.HELD, 0.9 * MIN_PRESS_INTERVAL_S
    )
    assert is_press_valid(PenetrationPhase.RETRACT, PenetrationPhase.RETRACT, MIN_PRESS_INTERVAL_S)


@pytest.mark.parametrize("phase", sorted(RUNNING_PHASES))
def test_only_the_present_phase_is_lit(phase):
    phases_with_light = [
        strip_phase
        for strip_phase, light in zip(
            STRIP_PHASES, find_lights(PenetrationStatus(phase)), strict=True
        )
        if light
    ]
    present_phases = [
        strip_phase
        for strip_phase, light in zip(
            STRIP_PHASES, find_lights(PenetrationStatus(phase, run=RUN)), strict=True
        )
        if light is PhaseLight.PRESENT
    ]
    assert len(phases_with_light) == len(STRIP_PHASES)
    assert present_phases == [
        PenetrationPhase.HOLD if phase is PenetrationPhase.HOLD_AFTER else phase
    ]


def test_after_a_run_the_strip_shows_the_passed_phases():
    done_lights = find_lights(PenetrationStatus(PenetrationPhase.DONE, run=RUN))
    assert done_lights == (*(PhaseLight.PASSED,) * 4, PhaseLight.OFF, PhaseLight.PASSED)
    held_run = replace(
        RUN, verdict=PenetrationVerdict.HELD, phases=(*RUN.phases[:3], ("held", 3.0))
    )
    held_lights = find_lights(PenetrationStatus(PenetrationPhase.HELD, run=held_run))
    assert held_lights == (
        PhaseLight.PASSED,
        PhaseLight.PASSED,
        PhaseLight.HELD,
        PhaseLight.OFF,
        PhaseLight.OFF,
        PhaseLight.OFF,
    )
    assert set(find_lights(PenetrationStatus(PenetrationPhase.ARMED, run=RUN))) == {PhaseLight.OFF}


def test_each_phase_is_described():
    held = PenetrationStatus(PenetrationPhase.HELD, "a stop was requested", run=RUN)
    assert describe_status(held, None) == (
        "Held: a stop was requested. The tip stays in place; press Retract to return it, or "
        "Free the axes to move it manually."
    )
    assert (
        format_headline(PenetrationStatus(PenetrationPhase.ARMED, armed_remaining_s=41.6))
        == "armed, 42 s"
    )
    assert "press Start" in describe_status(
        PenetrationStatus(PenetrationPhase.ARMED, armed_remaining_s=41.6), None
    )
    retracting = PenetrationStatus(PenetrationPhase.RETRACT, "overload: too far")
    assert describe_status(retracting, None).endswith("Reason: overload: too far.")
    done = PenetrationStatus(PenetrationPhase.DONE, run=RUN)
    assert describe_status(done, None) == (
        "Done: depth 49.50 µm, maximum speed 810 µm/s, error 0.30 µm from the "
        "profile. Ready to arm."
    )
    failed = replace(
        RUN, verdict=PenetrationVerdict.FAILED, reason="no contact within 10 µm", thrust=None
    )
    assert describe_status(
        PenetrationStatus(PenetrationPhase.FAILED, run=failed), "the machine is moving"
    ) == (
        "Failed: no contact within 10 µm. The tip is retracted. "
        "Cannot be armed now: the machine is moving."
    )
    timed_out = PenetrationStatus(PenetrationPhase.DISARMED, "it was not started in time", run=RUN)
    assert describe_status(timed_out, None) == "Disarmed: it was not started in time. Ready to arm."
