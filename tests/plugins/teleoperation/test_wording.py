"""What the panel says."""

from dataclasses import replace

import pytest

from rotemina.app.motion.teleoperation.axis_calibration import Calibration
from rotemina.app.motion.teleoperation.frames import Coordinate
from rotemina.app.motion.teleoperation.input_arbiter import DevicesView, DeviceView
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.mapped_device import AxisView
from rotemina.app.motion.teleoperation.profile import OperatorRole
from rotemina.app.motion.teleoperation.profile_check import PluggedDevice
from rotemina.app.motion.teleoperation.reference import Bounds
from rotemina.app.motion.teleoperation.scales import LawKind, Scale
from rotemina.app.motion.teleoperation.teleoperation_state import CoordinateView, TeleoperationState
from rotemina.app.shell.state_tone import Tone
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.plugins.teleoperation import wording
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
TABLE = Coordinate("x", "m", Bounds(0.0, 0.055, 0.01, 0.2), 0.0275)
STATE = TeleoperationState("micro", LawKind.RATE)


def device(source="hid", seat=OperatorRole.TRAINER, drives=True, problem=None, **reasons):
    """A device whose axes x, y, z are trusted but for reasons."""
    name = {"hid": "Thrust <3>", "keys": "pad"}[source]
    identity = InputIdentity(f"{source}:1", name, source)
    axes = tuple(AxisView(a.upper(), 0.0, 0.0, a, reasons.get(a)) for a in "xyz")
    axes += (AxisView("slider", 0.0, 0.0, None, "not at rest yet"),)
    plugged = PluggedDevice(identity, ("X", "Y", "Z", "slider"), ())
    return DeviceView(plugged, seat, drives, problem, axes, None, Calibration(device=identity.key))


STICK = DevicesView(1.0, (device(), device("keys", OperatorRole.TRAINEE, drives=False)))
PAD = DevicesView(1.0, (device("keys"),))


def view(kind, *, factor=1.0, waiting=False, **scale):
    law = replace(Scale.preset(TABLE), **scale).law(kind, TABLE, 0.0)
    law.rescale(factor)
    return CoordinateView("x", "m", "x", 0.0, 0.0275, waiting, law)


def test_the_device_that_drives_is_named():
    assert wording.driver_text(STICK) == "Thrust <3>"
    assert wording.driver_text(PAD) == "On-screen pad"
    assert wording.driver_text(DevicesView()) == "No device in control"


def test_trust_has_its_reasons_each_once_and_only_of_what_moves():
    assert wording.trust_text(STICK) == "Active"
    doubted = DevicesView(1.0, (device(x="let go of it", z="let go of it", y="jitters"),))
    assert wording.trust_text(doubted) == "Not active: X, Z: let go of it; Y: jitters"
    broken = DevicesView(1.0, (device(problem="no axis 'X'"),))
    assert wording.trust_text(broken) == "Not active: no axis 'X'"
    assert wording.trust_text(DevicesView(problems=("no profile",))) == "no profile"


@pytest.mark.parametrize(
    ("state", "stale", "word", "tone"),
    [
        (STATE, False, "input ready", Tone.QUIET),
        (replace(STATE, driving=True, reason="x"), False, "in control", Tone.BUSY),
        (replace(STATE, driving=True), True, "no answer", Tone.DANGER),
        (replace(STATE, reason="a fault"), False, "blocked", Tone.WARNING),
        (
            replace(STATE, coordinates=(view(LawKind.RATE, waiting=True),)),
            False,
            "waiting",
            Tone.WARNING,
        ),
    ],
)
def test_how_it_stands_is_one_word(state, stale, word, tone):
    assert wording.standing(STICK, state, stale=stale) == (word, tone)


def test_a_loop_that_does_not_answer_is_told_before_all_else():
    assert "do not respond" in wording.reason_text(replace(STATE, driving=True), stale=True)
    held = replace(STATE, reason="the machine is playing")
    assert wording.reason_text(held, stale=False) == "Hand control waits: the machine is playing."


@pytest.mark.parametrize(
    ("found", "why"),
    [
        (DevicesView(), "being opened"),
        (PAD, None),
        (replace(PAD, setting_up=True), "being set up"),
        (STICK, "Thrust <3> is in control; take over"),
        (DevicesView(1.0, (device("keys", None, drives=False),)), "does not map the pad"),
    ],
)
def test_the_pad_says_why_it_moves_nothing(found, why):
    told = wording.against_pad(found)
    assert (told is None) if why is None else (why in told)


def test_only_beside_another_device_the_pad_may_take_over():
    assert wording.is_trainee(wording.pad_of(STICK))
    assert not wording.is_trainee(wording.pad_of(PAD))
    assert not wording.is_trainee(wording.pad_of(DevicesView()))


@pytest.mark.parametrize(
    ("shown", "travel_m", "text"),
    [
        (view(LawKind.POSITION, way=2e-4), 0.02, "1 mm of stick = 10 µm of tip"),
        (view(LawKind.POSITION, way=2e-4, factor=0.1), None, "full deflection = 20 µm"),
        (view(LawKind.RATE, speed=1.23456e-3), 0.02, "full deflection = 1.23 mm/s"),
        (
            view(LawKind.RATE, speed=5e-3, factor=10.0),
            None,
            "full deflection = 8 mm/s",
        ),  # the bound
        (
            view(LawKind.IMPEDANCE, speed=1e-3, factor=0.5),
            None,
            "full deflection: 500 µm/s, time constant 0.2 s",
        ),
        (
            view(LawKind.IMPEDANCE, speed=4e-3, factor=10.0),
            None,
            "full deflection: 16 mm/s, time constant 0.2 s",  # cut by the acceleration
        ),
        (
            view(LawKind.IMPEDANCE, way=4e-4, spring_hz=0.5),
            None,
            "full deflection: 400 µm, 0.5 Hz, damping ratio 1, time constant 0.318 s",
        ),
    ],
)
def test_full_deflection_is_told_as_it_acts_now(shown, travel_m, text):
    assert wording.law_text(shown, "tip", travel_m) == text


def test_coordinates_of_the_tip_are_no_axes():
    assert wording.coordinate_name("micro", "x", "m") == "X"
    assert wording.coordinate_name("hybrid", "x", "m") == "Tip x"
    assert wording.coordinate_name("pivot", "thx", "rad") == "θx"
    tip = wording.coordinate_scale(ROBOT, "fine", "x", "m")
    assert tip.text(0.0274767479) == "27.47675 mm"
    assert wording.coordinate_scale(ROBOT, "nano", "zn", "m").text(3.25e-5) == "32.500 µm"


def test_the_factor_says_what_makes_it():
    assert wording.factor_text(0.1, {Action.FINE, Action.CLUTCH}) == "now × 0.1 (fine)"
    assert wording.factor_text(2.0, frozenset()) == "now × 2"


def test_the_clutch_is_told_where_it_counts():
    assert "space" in wording.clutch_text(LawKind.POSITION, frozenset())
    assert "stop the robot" in wording.clutch_text(LawKind.RATE, frozenset())
    assert "without the robot" in wording.clutch_text(LawKind.RATE, {Action.CLUTCH})


@pytest.mark.parametrize(
    ("left", "text"),
    [(0.5, "50 %"), (0.1, "10 % – re-centre"), (None, "not shared in this mode")],
)
def test_little_range_says_what_to_do(left, text):
    begun = replace(STATE, coordinates=(view(LawKind.RATE),), reserve=left)
    assert wording.reserve_text(begun) == text
    assert wording.reserve_text(STATE) == "–"


def test_a_tilt_is_told_without_what_rounding_makes():
    begun = replace(STATE, coordinates=(view(LawKind.RATE),))
    assert wording.tilt_shown(replace(begun, tilt=1e-3)) == "206 arcsec (1 mrad)"
    assert wording.tilt_shown(replace(begun, tilt=3e-16)) == "0 arcsec (0 mrad)"
    assert wording.tilt_shown(begun) == "not in this mode"
    assert wording.tilt_shown(STATE) == "–"


def test_modes_of_other_robots_have_buttons_too():
    assert wording.mode_choice("gantry").text == "Gantry"
    assert wording.mode_choice("pivot").tip.endswith(".")
