"""Texts of the teleoperation panel."""

from dataclasses import replace

import pytest

from rotemina.app.motion.inputs import (
    InputAxisView,
    InputCalibration,
    InputDeviceView,
    InputDisplayState,
    OperatorAction,
    OperatorRole,
    PluggedDevice,
)
from rotemina.app.motion.teleoperation import (
    CoordinateScale,
    CoordinateView,
    FrameCoordinate,
    LawKind,
    TeleoperationState,
)
from rotemina.app.motion.teleoperation.reference import CoordinateBounds
from rotemina.app.workbench import StateTone
from rotemina.drivers.inputs import InputIdentity
from rotemina.plugins.teleoperation import wording
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
TABLE = FrameCoordinate("x", "m", CoordinateBounds(0.0, 0.055, 0.01, 0.2), 0.0275)
STATE = TeleoperationState("micro", LawKind.RATE)


def make_device_view(source="hid", seat=OperatorRole.TRAINER, drives=True, problem=None, **reasons):
    """Return a device whose axes x, y and z are trusted, except those with a reason."""
    name = {"hid": "Thrust <3>", "keys": "pad"}[source]
    identity = InputIdentity(f"{source}:1", name, source)
    axes = tuple(InputAxisView(axis.upper(), 0.0, 0.0, axis, reasons.get(axis)) for axis in "xyz")
    axes += (InputAxisView("slider", 0.0, 0.0, None, "not at rest yet"),)
    plugged = PluggedDevice(identity, ("X", "Y", "Z", "slider"), ())
    return InputDeviceView(
        plugged, seat, drives, problem, axes, None, InputCalibration(device=identity.key)
    )


STICK = InputDisplayState(
    1.0, (make_device_view(), make_device_view("keys", OperatorRole.TRAINEE, drives=False))
)
PAD = InputDisplayState(1.0, (make_device_view("keys"),))


def make_coordinate_view(kind, *, factor=1.0, waiting=False, **scale):
    law = replace(CoordinateScale.make_preset(TABLE), **scale).make_law(kind, TABLE, 0.0)
    law.rescale(factor)
    return CoordinateView("x", "m", "x", 0.0, 0.0275, waiting, law)


def test_trust_is_explained_with_each_reason_once():
    assert wording.describe_trust(STICK) == "Active"
    untrusted = InputDisplayState(
        1.0, (make_device_view(x="let go of it", z="let go of it", y="jitters"),)
    )
    assert wording.describe_trust(untrusted) == "Not active: X, Z: let go of it; Y: jitters"
    broken = InputDisplayState(1.0, (make_device_view(problem="no axis 'X'"),))
    assert wording.describe_trust(broken) == "Not active: no axis 'X'"
    assert wording.describe_trust(InputDisplayState(problems=("no profile",))) == "no profile"


@pytest.mark.parametrize(
    ("state", "stale", "word", "tone"),
    [
        (STATE, False, "input ready", StateTone.QUIET),
        (replace(STATE, is_driving=True, reason="x"), False, "in control", StateTone.BUSY),
        (replace(STATE, is_driving=True), True, "no answer", StateTone.DANGER),
        (replace(STATE, reason="a fault"), False, "blocked", StateTone.WARNING),
        (
            replace(STATE, coordinates=(make_coordinate_view(LawKind.RATE, waiting=True),)),
            False,
            "waiting",
            StateTone.WARNING,
        ),
    ],
)
def test_the_state_is_described_by_one_word_and_a_tone(state, stale, word, tone):
    assert wording.describe_state(STICK, state, stale=stale) == (word, tone)


def test_an_unresponsive_loop_is_reported_first():
    driving = replace(STATE, is_driving=True)
    assert "do not respond" in wording.explain_no_motion(driving, stale=True)
    waiting = replace(STATE, reason="the machine is playing")
    text = wording.explain_no_motion(waiting, stale=False)
    assert text == "Hand control waits: the machine is playing."


@pytest.mark.parametrize(
    ("display_state", "reason"),
    [
        (InputDisplayState(), "being opened"),
        (PAD, None),
        (replace(PAD, is_mapping_open=True), "being set up"),
        (STICK, "Thrust <3> is in control; take over"),
        (
            InputDisplayState(1.0, (make_device_view("keys", None, drives=False),)),
            "does not map the pad",
        ),
    ],
)
def test_the_pad_has_a_reason_if_it_cannot_move_the_robot(display_state, reason):
    objection = wording.find_pad_objection(display_state)
    assert (objection is None) if reason is None else (reason in objection)


@pytest.mark.parametrize(
    ("coordinate", "travel_m", "text"),
    [
        (make_coordinate_view(LawKind.POSITION, way=2e-4), 0.02, "1 mm of stick = 10 µm of tip"),
        (
            make_coordinate_view(LawKind.POSITION, way=2e-4, factor=0.1),
            None,
            "full deflection = 20 µm",
        ),
        # The speed is bounded.
        (
            make_coordinate_view(LawKind.RATE, speed=5e-3, factor=10.0),
            None,
            "full deflection = 8 mm/s",
        ),
        (
            make_coordinate_view(LawKind.IMPEDANCE, speed=4e-3, factor=10.0),
            None,
            "full deflection: 16 mm/s, time constant 0.2 s",  # limited by the acceleration
        ),
        (
            make_coordinate_view(LawKind.IMPEDANCE, way=4e-4, spring_hz=0.5),
            None,
            "full deflection: 400 µm, 0.5 Hz, damping ratio 1, time constant 0.318 s",
        ),
    ],
)
def test_the_effect_of_a_full_deflection_is_described(coordinate, travel_m, text):
    assert wording.describe_law(coordinate, "tip", travel_m) == text


def test_the_factor_is_shown_with_its_cause():
    held = {OperatorAction.FINE, OperatorAction.CLUTCH}
    assert wording.format_factor(0.1, held) == "now × 0.1 (fine)"
    assert wording.format_factor(2.0, frozenset()) == "now × 2"


def test_a_small_reserve_suggests_recentring():
    state = replace(STATE, coordinates=(make_coordinate_view(LawKind.RATE),))
    texts = [wording.format_reserve(replace(state, reserve=share)) for share in (0.5, 0.1, None)]
    assert texts == ["50 %", "10 % – re-centre", "not available in this mode"]
    assert wording.format_reserve(STATE) == "–"


def test_the_clutch_is_described_for_each_law():
    assert "space" in wording.describe_clutch(LawKind.POSITION, frozenset())
    assert "stop the robot" in wording.describe_clutch(LawKind.RATE, frozenset())
    assert "without the robot" in wording.describe_clutch(LawKind.RATE, {OperatorAction.CLUTCH})


def test_a_tilt_is_shown_without_rounding_errors():
    state = replace(STATE, coordinates=(make_coordinate_view(LawKind.RATE),))
    assert wording.describe_tilt(replace(state, tilt=1e-3)) == "206 arcsec (1 mrad)"
    assert wording.describe_tilt(replace(state, tilt=3e-16)) == "0 arcsec (0 mrad)"
    assert wording.describe_tilt(state) == "not in this mode"
    assert wording.describe_tilt(STATE) == "–"
