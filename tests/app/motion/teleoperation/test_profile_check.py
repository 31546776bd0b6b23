import pytest

from rotemina.app.errors import InputProfileError
from rotemina.app.motion.inputs import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    InputProfile,
    OperatorAction,
    OperatorRole,
    PluggedDevice,
    assign_mappings,
    check_profile,
)
from rotemina.app.motion.inputs.default_profile import make_default_profile
from rotemina.app.motion.inputs.profile_check import check_controls, describe_missing_devices
from rotemina.drivers.inputs import InputIdentity

ROBOT = ("x", "y", "z", "thx", "thy", "zn")


def make_device(key="hid:1", axes=("X", "Y", "Z"), buttons=("Button 1", "Button 2"), source="hid"):
    return PluggedDevice(InputIdentity(key, f"Stick {key}", source), axes, buttons)


def map_axis(control, drives):
    return AxisMapping(control=control, drives=drives)


def map_action(control, map_action, **options):
    return ActionMapping(control=control, action=map_action, **options)


def make_profile(*devices):
    return InputProfile(name="Bench", devices=devices)


def check_all(make_profile, robot_axes, devices):
    """Refuse a profile that does not fit the robot or the devices."""
    check_profile(make_profile, robot_axes)
    if (missing := describe_missing_devices(make_profile, devices)) is not None:
        raise InputProfileError(missing)
    mappings = assign_mappings(make_profile, devices)
    for make_device in devices:
        if make_device.identity.key in mappings:
            check_controls(mappings[make_device.identity.key], make_device)


@pytest.mark.parametrize(
    ("mapping", "message_parts"),
    [
        (
            (map_axis("X", "x"), map_axis("Y", "x")),
            ["robot axis x", "'X' of hid:1", "'Y' of hid:1"],
        ),
        ((map_axis("X", "z"), map_axis("Y", "zn")), ["robot axis zn", "(drives z)", "(drives zn)"]),
        ((map_axis("X", "thx"), map_axis("Y", "y")), ["robot axis thx", "'X' of", "'Y' of"]),
        ((map_axis("X", "phi"),), ["'X' drives 'phi'", "known: x, y, z, thx, thy, zn"]),
        ((map_axis("X", "x"), map_axis("X", "y")), ["control 'X'", "drives x and drives y"]),
    ],
)
def test_impossible_axis_mappings_are_refused(mapping, message_parts):
    with pytest.raises(InputProfileError) as caught:
        check_profile(make_profile(DeviceMapping(key="hid:1", axes=mapping)), ROBOT)
    assert all(part in str(caught.value) for part in message_parts)


def test_two_seats_may_drive_the_same_axis_but_not_two_devices_of_one_seat():
    trainer = DeviceMapping(key="hid:*", axes=(map_axis("X", "x"),))
    trainee = DeviceMapping(key="b", axes=(map_axis("X", "x"),), seat=OperatorRole.TRAINEE)
    check_profile(make_profile(trainer, trainee), ROBOT)
    with pytest.raises(InputProfileError, match="one must have 'trainer'"):
        check_profile(make_profile(trainee), ROBOT)
    second_trainer = DeviceMapping(key="hid:*", axes=(map_axis("X", "x"),))
    with pytest.raises(InputProfileError, match=r"'X' of hid:\* .* and 'X' of hid:\*"):
        check_profile(make_profile(trainer, second_trainer), ROBOT)


@pytest.mark.parametrize(
    ("axes", "actions", "message"),
    [
        (
            (),
            (map_action("1", OperatorAction.STOP), map_action("1", OperatorAction.LAW)),
            "'1' of hid:1 .* stop and law",
        ),
        (
            (),
            (
                map_action("X", OperatorAction.STOP, at=0.5),
                map_action("X", OperatorAction.LAW, at=0.9),
            ),
            "'X' of hid:1",
        ),
        (
            (map_axis("X", "x"),),
            (map_action("X", OperatorAction.STOP, at=0.9),),
            "drives x and stop",
        ),
    ],
)
def test_a_control_may_have_only_one_function(axes, actions, message):
    mapping = DeviceMapping(key="hid:1", axes=axes, actions=actions)
    with pytest.raises(InputProfileError, match=message):
        check_profile(make_profile(mapping), ROBOT)


def test_an_axis_may_have_one_action_per_direction_and_share_a_buttons_name():
    actions = (
        map_action("X", OperatorAction.FINE, at=-0.5),
        map_action("X", OperatorAction.COARSE, at=0.5),
        map_action("X", OperatorAction.STOP),
    )
    check_profile(make_profile(DeviceMapping(key="hid:1", actions=actions)), ROBOT)


def test_a_profile_for_another_device_names_it_and_the_connected_ones():
    profile = make_profile(DeviceMapping(key="hid:046d:*", axes=(map_axis("X", "x"),)))
    with pytest.raises(InputProfileError) as caught:
        check_all(profile, ROBOT, [make_device("hid:054c:1")])
    assert "needs hid:046d:*" in str(caught.value)
    assert "connected: Stick hid:054c:1 (hid:054c:1)" in str(caught.value)
    assert "connected: nothing" in describe_missing_devices(profile, [])


@pytest.mark.parametrize(
    ("controls", "message"),
    [
        ({"axes": (map_axis("Rz", "z"),)}, "no axis 'Rz'; it has X, Y, Z"),
        ({"actions": (map_action("9", OperatorAction.STOP),)}, "no button '9'; it has Bu"),
        ({"actions": (map_action("X", OperatorAction.STOP),)}, "an axis needs at = "),
        (
            {"actions": (map_action("Button 1", OperatorAction.STOP, at=0.5),)},
            "no axis 'Button 1'",
        ),
    ],
)
def test_controls_that_a_device_does_not_have_are_refused(controls, message):
    with pytest.raises(InputProfileError) as caught:
        check_all(make_profile(DeviceMapping(key="*", **controls)), ROBOT, [make_device()])
    assert message in str(caught.value)


def test_a_full_key_has_priority_over_a_pattern_and_a_device_has_one_mapping():
    pattern, full = DeviceMapping(key="hid:*"), DeviceMapping(key="hid:2")
    profile = make_profile(pattern, full, DeviceMapping(key="hid:*", seat=OperatorRole.TRAINEE))
    mappings = assign_mappings(
        profile,
        [make_device("hid:2"), make_device("hid:1"), make_device("hid:3"), make_device("hid:4")],
    )
    assert mappings == {"hid:2": full, "hid:1": pattern, "hid:3": profile.devices[2]}


@pytest.mark.parametrize(
    ("axes", "controls"),
    [
        (("Slider", "Rz", "Y", "X", "Hat x", "Hat y"), ["X", "Y", "Rz"]),
        (("X", "Y", "Z", "Rz", "Rx", "Ry"), ["X", "Y", "Rz"]),
        (("φ1", "φ2", "φ3", "φ4"), ["φ1", "φ2", "φ3"]),
        (("Throttle", "Brake"), []),
    ],
)
def test_every_device_has_a_fitting_default_profile(axes, controls):
    device = make_device(axes=axes)
    profile = make_default_profile(device)
    check_all(profile, ROBOT, [device])
    assert [mapping.control for mapping in profile.devices[0].axes] == controls


@pytest.mark.parametrize(
    ("buttons", "actions"),
    [
        (
            ("Button 1", "Button 2", "Button 3"),
            [OperatorAction.DEAD_MAN, OperatorAction.STOP, OperatorAction.STAGE],
        ),
        (("0", "1"), [OperatorAction.PENETRATION, OperatorAction.STAGE]),
        (("Mode", "Start/stop penetration"), [OperatorAction.STAGE, OperatorAction.PENETRATION]),
        (("emergency_stop", "stop", "take-over"), ["emergency_stop", "stop", "take_over"]),
        (tuple(map(str, range(32))), None),
    ],
)
def test_default_buttons_match_their_names(buttons, actions):
    device = make_device(buttons=buttons)
    profile = make_default_profile(device)
    check_all(profile, ROBOT, [device])
    if actions is not None:
        assert [mapping.action for mapping in profile.devices[0].actions] == actions


def test_default_directions_of_a_stick_are_inverted_in_y_and_z():
    inverted = [mapping.inverted for mapping in make_default_profile(make_device()).devices[0].axes]
    assert inverted == [False, True, True]
    profile = make_default_profile(make_device(source="keyboard"))
    assert not any(mapping.inverted for mapping in profile.devices[0].axes)


def test_a_device_without_controls_cannot_be_mapped():
    with pytest.raises(InputProfileError, match="neither axes nor buttons"):
        make_default_profile(make_device(axes=(), buttons=()))
