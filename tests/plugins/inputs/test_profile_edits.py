"""Changes of a profile: what they change, what they leave, and what is refused for them."""

import pytest

from rotemina.app.motion.teleoperation.axis_calibration import AxisCalibration, Calibration
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.moved_control import Detected, Kind
from rotemina.app.motion.teleoperation.profile import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    OperatorRole,
    Profile,
    ProfileError,
    SilencePolicy,
)
from rotemina.app.motion.teleoperation.profile_check import PluggedDevice, check_profile
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.plugins.inputs.profile_edits import Edited, exchanged, threshold, turned

ROBOT = ("x", "y", "z", "thx", "thy", "zn")


def plugged(key):
    return PluggedDevice(InputIdentity(key, key, "hid"), ("X", "Y"), ("1", "2"))


STICK, PEDAL = plugged("hid:stick"), plugged("hid:pedal")
STOPS = (ActionMapping(control="1", action=Action.STOP),)
BENCH = Profile(
    name="Bench",
    devices=(
        DeviceMapping(key="hid:st*", axes=(AxisMapping(control="X", drives="x", inverted=True),)),
        DeviceMapping(key="hid:pedal", seat=OperatorRole.TRAINEE, actions=STOPS),
    ),
)


def edited(profile=BENCH, device=STICK):
    return Edited(profile, device, (STICK, PEDAL))


def test_a_target_gets_another_control_and_all_else_stays():
    changed = edited().with_axis("x", "Y")
    assert edited(changed).axis("x") == AxisMapping(control="Y", drives="x")
    assert changed.devices[0].key == "hid:st*"  # the pattern stays one
    assert changed.devices[1] == BENCH.devices[1]
    assert edited().axis("x").inverted  # what was edited has not changed
    assert edited(edited(changed).without_axis("x")).axis("x") is None


def test_an_action_gets_another_control_and_may_lose_it():
    changed = edited(device=PEDAL).with_action(Action.STOP, "Y", -0.5)
    assert edited(changed, PEDAL).actions(Action.STOP) == (
        ActionMapping(control="Y", action=Action.STOP, at=-0.5),
    )
    moved = edited(changed, PEDAL).with_threshold(Action.STOP, 0.8)
    assert edited(moved, PEDAL).actions(Action.STOP)[0].at == 0.8
    gone = edited(moved, PEDAL).without_action(Action.STOP)
    assert edited(gone, PEDAL).actions(Action.STOP) == ()


@pytest.mark.parametrize("at", [0.05, -0.09, 1.2])
def test_a_threshold_that_cannot_be_is_refused(at):
    with pytest.raises(
        ProfileError, match=r"stop: the threshold of .* % of the deflection must be"
    ):
        edited(device=PEDAL).with_threshold(Action.STOP, at)


def test_two_owners_come_out_of_it_and_are_both_named_where_it_is_used():
    changed = edited(edited().with_axis("y", "Y")).with_axis("thx", "X")
    with pytest.raises(ProfileError, match=r"'Y' of hid:st\* .*'X' of hid:st\*"):
        check_profile(changed, ROBOT)


def test_a_device_that_the_profile_lacks_is_added():
    other = plugged("hid:other")
    view = Edited(BENCH, other, (STICK, PEDAL, other))
    assert view.mapping is None
    changed = view.with_action(Action.TAKE_OVER, "2")
    assert [each.key for each in changed.devices] == ["hid:st*", "hid:pedal", "hid:other"]


def test_without_a_profile_one_is_made():
    changed = Edited(None, STICK, (STICK,)).with_axis("x", "X")
    assert changed.devices[0].axes == (AxisMapping(control="X", drives="x"),)
    check_profile(changed, ROBOT)


def test_a_device_continues_while_silent_only_if_that_was_chosen():
    assert edited().mapping.when_silent is SilencePolicy.STOP
    changed = edited().with_silence(SilencePolicy.CONTINUE)
    assert edited(changed).mapping.when_silent is SilencePolicy.CONTINUE
    assert edited(changed).axis("x") == edited().axis("x")
    assert changed.devices[1] == BENCH.devices[1]


def test_a_device_takes_a_seat_or_none():
    assert (
        edited(edited(device=PEDAL).with_seat(OperatorRole.TRAINER), PEDAL).mapping.seat
        is OperatorRole.TRAINER
    )
    alone = edited(device=PEDAL).with_seat(None)
    assert [each.key for each in alone.devices] == ["hid:st*"]
    with pytest.raises(ProfileError, match="would have no device"):
        edited(alone).with_seat(None)


def test_seats_are_exchanged_at_once():
    assert [each.seat for each in exchanged(BENCH).devices] == [
        OperatorRole.TRAINEE,
        OperatorRole.TRAINER,
    ]
    assert exchanged(exchanged(BENCH)) == BENCH


@pytest.mark.parametrize("inverted", [False, True])
@pytest.mark.parametrize("direction", [1, -1])
def test_the_way_in_which_it_was_moved_is_forwards(inverted, direction):
    calibration = Calibration(device="a", axes={"X": AxisCalibration(inverted=inverted)})
    found = Detected("a", "X", Kind.AXIS, direction)
    deflection = calibration.axis("X").deflection(direction * 1.0)
    turn = -1.0 if turned(found, calibration) else 1.0
    assert turn * deflection > 0.0
    assert threshold(found, calibration) * deflection > 0.0
    assert threshold(Detected("a", "1", Kind.BUTTON, 1), calibration) is None
