"""Edits of a profile: their effect, the parts that stay unchanged, and refused edits."""

import pytest

from rotemina.app.errors import InputProfileError
from rotemina.app.motion.inputs import (
    ActionMapping,
    AxisMapping,
    ControlKind,
    DeviceMapping,
    InputAxisCalibration,
    InputCalibration,
    InputProfile,
    MovedControl,
    OperatorAction,
    OperatorRole,
    PluggedDevice,
    SilencePolicy,
    check_profile,
)
from rotemina.drivers.inputs import InputIdentity
from rotemina.plugins.inputs.profile_edits import (
    ProfileEditor,
    compute_threshold,
    exchange_seats,
    is_inversion_needed,
)

ROBOT = ("x", "y", "z", "thx", "thy", "zn")


def make_device(key):
    return PluggedDevice(InputIdentity(key, key, "hid"), ("X", "Y"), ("1", "2"))


STICK, PEDAL = make_device("hid:stick"), make_device("hid:pedal")
STOP_MAPPINGS = (ActionMapping(control="1", action=OperatorAction.STOP),)
PROFILE = InputProfile(
    name="Bench",
    devices=(
        DeviceMapping(key="hid:st*", axes=(AxisMapping(control="X", drives="x", inverted=True),)),
        DeviceMapping(key="hid:pedal", seat=OperatorRole.TRAINEE, actions=STOP_MAPPINGS),
    ),
)


def make_editor(profile=PROFILE, device=STICK):
    return ProfileEditor(profile, device, (STICK, PEDAL))


def test_a_target_gets_another_control_and_the_rest_stays():
    changed = make_editor().with_axis("x", "Y")
    assert make_editor(changed).find_axis_mapping("x") == AxisMapping(control="Y", drives="x")
    assert changed.devices[0].key == "hid:st*"  # the pattern is kept
    assert changed.devices[1] == PROFILE.devices[1]
    assert make_editor().find_axis_mapping("x").inverted  # the edited profile itself is unchanged
    assert make_editor(make_editor(changed).without_axis("x")).find_axis_mapping("x") is None


def test_an_action_gets_another_control_and_loses_it():
    changed = make_editor(device=PEDAL).with_action(OperatorAction.STOP, "Y", -0.5)
    assert make_editor(changed, PEDAL).find_action_mappings(OperatorAction.STOP) == (
        ActionMapping(control="Y", action=OperatorAction.STOP, at=-0.5),
    )
    with_threshold = make_editor(changed, PEDAL).with_threshold(OperatorAction.STOP, 0.8)
    assert make_editor(with_threshold, PEDAL).find_action_mappings(OperatorAction.STOP)[0].at == 0.8
    without_action = make_editor(with_threshold, PEDAL).without_action(OperatorAction.STOP)
    assert make_editor(without_action, PEDAL).find_action_mappings(OperatorAction.STOP) == ()


@pytest.mark.parametrize("threshold", [-0.09, 1.2])
def test_a_threshold_out_of_bounds_is_refused(threshold):
    with pytest.raises(
        InputProfileError, match=r"stop: the threshold of .* % of the deflection must be"
    ):
        make_editor(device=PEDAL).with_threshold(OperatorAction.STOP, threshold)


def test_a_missing_device_is_added_to_the_profile():
    other = make_device("hid:other")
    editor = ProfileEditor(PROFILE, other, (STICK, PEDAL, other))
    assert editor.mapping is None
    changed = editor.with_action(OperatorAction.TAKE_OVER, "2")
    assert [mapping.key for mapping in changed.devices] == ["hid:st*", "hid:pedal", "hid:other"]


def test_an_edit_without_a_profile_creates_one():
    changed = ProfileEditor(None, STICK, (STICK,)).with_axis("x", "X")
    assert changed.devices[0].axes == (AxisMapping(control="X", drives="x"),)
    check_profile(changed, ROBOT)


def test_a_silent_device_continues_only_if_that_was_chosen():
    assert make_editor().mapping.when_silent is SilencePolicy.STOP
    changed = make_editor().with_silence(SilencePolicy.CONTINUE)
    assert make_editor(changed).mapping.when_silent is SilencePolicy.CONTINUE
    assert make_editor(changed).find_axis_mapping("x") == make_editor().find_axis_mapping("x")
    assert changed.devices[1] == PROFILE.devices[1]


def test_a_device_gets_a_seat_or_is_removed():
    assert (
        make_editor(make_editor(device=PEDAL).with_seat(OperatorRole.TRAINER), PEDAL).mapping.seat
        is OperatorRole.TRAINER
    )
    without_pedal = make_editor(device=PEDAL).with_seat(None)
    assert [mapping.key for mapping in without_pedal.devices] == ["hid:st*"]
    with pytest.raises(InputProfileError, match="would have no device"):
        make_editor(without_pedal).with_seat(None)


def test_the_seats_of_both_devices_are_exchanged():
    assert [mapping.seat for mapping in exchange_seats(PROFILE).devices] == [
        OperatorRole.TRAINEE,
        OperatorRole.TRAINER,
    ]
    assert exchange_seats(exchange_seats(PROFILE)) == PROFILE


@pytest.mark.parametrize("inverted", [False, True])
@pytest.mark.parametrize("direction", [1, -1])
def test_the_direction_of_the_movement_becomes_positive(inverted, direction):
    calibration = InputCalibration(device="a", axes={"X": InputAxisCalibration(inverted=inverted)})
    moved_control = MovedControl("a", "X", ControlKind.AXIS, direction)
    deflection = calibration.find_axis("X").compute_deflection(direction * 1.0)
    sign = -1.0 if is_inversion_needed(moved_control, calibration) else 1.0
    assert sign * deflection > 0.0
    assert compute_threshold(moved_control, calibration) * deflection > 0.0
    assert compute_threshold(MovedControl("a", "1", ControlKind.BUTTON, 1), calibration) is None
