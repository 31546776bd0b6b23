"""What the buttons do in each phase, and what is said of it."""

from dataclasses import replace

import pytest

from rotemina.app.motion.penetration.run_log import PenetrationRun, Verdict
from rotemina.app.motion.penetration.status import UNDER_WAY, PenetrationStatus, Phase
from rotemina.app.motion.penetration.thrust import ThrustMeasured
from rotemina.app.motion.state import SessionState
from rotemina.plugins.penetration.words import (
    FIXED,
    SETTLE_S,
    STRIP,
    Light,
    against_button,
    arm_word,
    button_word,
    counts,
    headline,
    lights,
    message,
)

RUN = PenetrationRun(
    started="2026-11-21T10:00:00+00:00",
    robot="RoTeMiNa",
    driver="simulator",
    parameters={},
    verdict=Verdict.DONE,
    reason="",
    phases=tuple(
        (name, float(at))
        for at, name in enumerate(
            ("approach", "contact", "thrust", "hold", "hold after", "retract", "done")
        )
    ),
    thrust=ThrustMeasured(4.95e-5, 3e-7, 2e-3, 5.5e-4, 8.1e-4, 1000.0),
)


@pytest.mark.parametrize("phase", Phase)
def test_the_button_says_what_a_press_does(phase):
    words = {Phase.RETRACT: "Hold", Phase.HELD: "Retract"}
    usual = "Stop and retract" if phase in UNDER_WAY else "Start"
    assert button_word(phase) == words.get(phase, usual)
    other = {Phase.ARMED: "Disarm", Phase.HELD: "Free the axes"}
    assert arm_word(phase) == other.get(phase, "Arm")
    status = PenetrationStatus(phase)
    assert (against_button(status, SessionState()) is None) == (
        phase in FIXED and (phase is not Phase.HELD or SessionState().locked is None)
    )


def test_a_held_tip_that_cannot_be_moved_says_why():
    status = PenetrationStatus(Phase.HELD)
    assert against_button(status, SessionState(locked="it is latched")) == "it is latched"
    assert against_button(status, SessionState(locked=None)) is None


def test_a_press_acts_as_it_was_labelled_or_not_at_all():
    # It had said "Stop and retract", and went back by itself meanwhile: it must not be held.
    assert not counts(Phase.HOLD, Phase.RETRACT, 10.0)
    assert not counts(Phase.ARMED, Phase.DISARMED, 10.0) or button_word(Phase.DISARMED) == "Start"
    assert counts(Phase.APPROACH, Phase.CONTACT, 0.0)
    # A second click in alarm neither halts the way back nor begins one.
    assert not counts(Phase.RETRACT, Phase.RETRACT, 0.9 * SETTLE_S)
    assert not counts(Phase.HELD, Phase.HELD, 0.9 * SETTLE_S)
    assert counts(Phase.RETRACT, Phase.RETRACT, SETTLE_S)


@pytest.mark.parametrize("phase", sorted(UNDER_WAY))
def test_the_present_phase_alone_is_lit(phase):
    lit = [one for one, light in zip(STRIP, lights(PenetrationStatus(phase)), strict=True) if light]
    found = [
        one
        for one, light in zip(STRIP, lights(PenetrationStatus(phase, run=RUN)), strict=True)
        if light is Light.PRESENT
    ]
    assert len(lit) == len(STRIP)
    assert found == [Phase.HOLD if phase is Phase.HOLD_AFTER else phase]


def test_afterwards_the_strip_tells_how_far_it_came():
    done = lights(PenetrationStatus(Phase.DONE, run=RUN))
    assert done == (*(Light.PASSED,) * 4, Light.OFF, Light.PASSED)
    held = replace(RUN, verdict=Verdict.HELD, phases=(*RUN.phases[:3], ("held", 3.0)))
    found = lights(PenetrationStatus(Phase.HELD, run=held))
    assert found == (Light.PASSED, Light.PASSED, Light.HELD, Light.OFF, Light.OFF, Light.OFF)
    assert set(lights(PenetrationStatus(Phase.ARMED, run=RUN))) == {Light.OFF}


def test_what_is_said_of_each_phase():
    held = PenetrationStatus(Phase.HELD, "a stop was requested", run=RUN)
    assert message(held, None) == (
        "Held: a stop was requested. The tip stays in place; press Retract to return it, or "
        "Free the axes to move it manually."
    )
    assert headline(PenetrationStatus(Phase.ARMED, armed_left_s=41.6)) == "armed, 42 s"
    assert "press Start" in message(PenetrationStatus(Phase.ARMED, armed_left_s=41.6), None)
    back = PenetrationStatus(Phase.RETRACT, "overload: too far")
    assert message(back, None).endswith("Why: overload: too far.")
    done = PenetrationStatus(Phase.DONE, run=RUN)
    assert message(done, None) == (
        "Done: depth 49.50 µm, maximum speed 810 µm/s, error 0.30 µm from the "
        "profile. Ready to arm."
    )
    failed = replace(RUN, verdict=Verdict.FAILED, reason="no contact within 10 µm", thrust=None)
    assert message(PenetrationStatus(Phase.FAILED, run=failed), "the machine is moving") == (
        "Failed: no contact within 10 µm. The tip is retracted. "
        "Cannot be armed now: the machine is moving."
    )
    late = PenetrationStatus(Phase.DISARMED, "it was not started in time", run=RUN)
    assert message(late, None) == "Disarmed: it was not started in time. Ready to arm."
