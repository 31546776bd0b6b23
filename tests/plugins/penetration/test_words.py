"""Labels of the buttons and texts of the status in each phase."""

from dataclasses import replace

import pytest

from rotemina.app.motion.penetration import (
    PenetrationPhase,
    PenetrationRun,
    PenetrationStatus,
    PenetrationVerdict,
)
from rotemina.app.motion.penetration.thrust import MeasuredThrust
from rotemina.app.motion.state import SessionState
from rotemina.plugins.penetration import describe_status, format_headline
from rotemina.plugins.penetration.words import (
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


@pytest.mark.parametrize(
    ("phase", "button_text", "arm_text", "is_enabled"),
    [
        (PenetrationPhase.DISARMED, "Start", "Arm", False),
        (PenetrationPhase.ARMED, "Start", "Disarm", True),
        (PenetrationPhase.THRUST, "Stop and retract", "Arm", True),
        (PenetrationPhase.RETRACT, "Hold", "Arm", True),
        (PenetrationPhase.HELD, "Retract", "Free the axes", True),
    ],
)
def test_a_button_label_names_the_action_of_a_press(phase, button_text, arm_text, is_enabled):
    assert (find_button_text(phase), find_arm_text(phase)) == (button_text, arm_text)
    objection = find_button_objection(PenetrationStatus(phase), SessionState())
    assert (objection is None) is is_enabled
    if phase is PenetrationPhase.HELD:
        locked = SessionState(lock_reason="it is latched")
        assert find_button_objection(PenetrationStatus(phase), locked) == "it is latched"


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


@pytest.mark.parametrize(
    ("phase", "lit_phase"),
    [
        (PenetrationPhase.APPROACH, PenetrationPhase.APPROACH),
        (PenetrationPhase.HOLD_AFTER, PenetrationPhase.HOLD),
    ],
)
def test_only_the_present_phase_is_lit(phase, lit_phase):
    lights = find_lights(PenetrationStatus(phase, run=RUN))
    assert lights == tuple(
        PhaseLight.PRESENT if strip_phase is lit_phase else PhaseLight.OFF
        for strip_phase in STRIP_PHASES
    )


def test_after_a_run_the_strip_shows_the_passed_phases():
    done_lights = find_lights(PenetrationStatus(PenetrationPhase.DONE, run=RUN))
    assert done_lights == (*(PhaseLight.PASSED,) * 4, PhaseLight.OFF, PhaseLight.PASSED)
    held_run = replace(
        RUN, verdict=PenetrationVerdict.HELD, phases=(*RUN.phases[:3], ("held", 3.0))
    )
    held_lights = find_lights(PenetrationStatus(PenetrationPhase.HELD, run=held_run))
    assert held_lights == (*(PhaseLight.PASSED,) * 2, PhaseLight.HELD, *(PhaseLight.OFF,) * 3)
    assert set(find_lights(PenetrationStatus(PenetrationPhase.ARMED, run=RUN))) == {PhaseLight.OFF}


def test_each_phase_is_described():
    held = PenetrationStatus(PenetrationPhase.HELD, "a stop was requested", run=RUN)
    assert describe_status(held, None).startswith("Held: a stop was requested. The tip stays")
    armed = PenetrationStatus(PenetrationPhase.ARMED, armed_remaining_s=41.6)
    assert format_headline(armed) == "armed, 42 s"
    assert "press Start" in describe_status(armed, None)
    retracting = PenetrationStatus(PenetrationPhase.RETRACT, "overload: too far")
    assert describe_status(retracting, None).endswith("Reason: overload: too far.")
    done = describe_status(PenetrationStatus(PenetrationPhase.DONE, run=RUN), None)
    for part in ("depth 49.50 µm", "speed 810 µm/s", "error 0.30 µm", "Ready to arm."):
        assert part in done
    failed = replace(
        RUN, verdict=PenetrationVerdict.FAILED, reason="no contact within 10 µm", thrust=None
    )
    status = PenetrationStatus(PenetrationPhase.FAILED, run=failed)
    text = describe_status(status, "the machine is moving")
    assert text.startswith("Failed: no contact within 10 µm. The tip is retracted.")
    assert text.endswith("Cannot be armed now: the machine is moving.")
    timed_out = PenetrationStatus(PenetrationPhase.DISARMED, "it was not started in time", run=RUN)
    assert describe_status(timed_out, None) == "Disarmed: it was not started in time. Ready to arm."
