import pytest

from rotemina.app.motion.teleoperation.default_profile import default_profile
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.profile import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    OperatorRole,
    Profile,
    ProfileError,
)
from rotemina.app.motion.teleoperation.profile_check import (
    PluggedDevice,
    assigned,
    check_controls,
    check_profile,
    missing,
)
from rotemina.drivers.inputs.device import InputIdentity

ROBOT = ("x", "y", "z", "thx", "thy", "zn")


def device(key="hid:1", axes=("X", "Y", "Z"), buttons=("Button 1", "Button 2"), source="hid"):
    return PluggedDevice(InputIdentity(key, f"Stick {key}", source), axes, buttons)


def axis(control, drives):
    return AxisMapping(control=control, drives=drives)


def action(control, action, **options):
    return ActionMapping(control=control, action=action, **options)


def profile(*devices):
    return Profile(name="Bench", devices=devices)


def check(profile, robot_axes, devices):
    """Refuse a profile that does not fit robot and devices in any way."""
    check_profile(profile, robot_axes)
    if (absent := missing(profile, devices)) is not None:
        raise ProfileError(absent)
    found = assigned(profile, devices)
    for device in devices:
        if device.identity.key in found:
            check_controls(found[device.identity.key], device)


@pytest.mark.parametrize(
    ("mapping", "said"),
    [
        ((axis("X", "x"), axis("Y", "x")), ["robot axis x", "'X' of hid:1", "'Y' of hid:1"]),
        ((axis("X", "z"), axis("Y", "zn")), ["robot axis zn", "(drives z)", "(drives zn)"]),
        ((axis("X", "thx"), axis("Y", "y")), ["robot axis thx", "'X' of", "'Y' of"]),
        ((axis("X", "phi"),), ["'X' drives 'phi'", "known: x, y, z, thx, thy, zn"]),
        ((axis("X", "x"), axis("X", "y")), ["control 'X'", "drives x and drives y"]),
    ],
)
def test_axes_that_cannot_be_are_refused(mapping, said):
    with pytest.raises(ProfileError) as caught:
        check_profile(profile(DeviceMapping(key="hid:1", axes=mapping)), ROBOT)
    assert all(part in str(caught.value) for part in said)


def test_two_owners_on_two_alike_devices_are_found():
    one = DeviceMapping(key="hid:*", axes=(axis("X", "x"),))
    with pytest.raises(ProfileError, match=r"'X' of hid:\* .* and 'X' of hid:\*"):
        check_profile(profile(one, DeviceMapping(key="hid:*", axes=(axis("X", "x"),))), ROBOT)


def test_two_seats_may_drive_the_same():
    trainer = DeviceMapping(key="a", axes=(axis("X", "x"),))
    trainee = DeviceMapping(key="b", axes=(axis("X", "x"),), seat=OperatorRole.TRAINEE)
    check_profile(profile(trainer, trainee), ROBOT)
    with pytest.raises(ProfileError, match="one must have 'trainer'"):
        check_profile(profile(trainee), ROBOT)


@pytest.mark.parametrize(
    ("mapping", "said"),
    [
        ((action("1", Action.STOP), action("1", Action.LAW)), "'1' of hid:1 .* stop and law"),
        ((action("X", Action.STOP, at=0.5), action("X", Action.LAW, at=0.9)), "'X' of hid:1"),
    ],
)
def test_a_control_does_one_thing(mapping, said):
    with pytest.raises(ProfileError, match=said):
        check_profile(profile(DeviceMapping(key="hid:1", actions=mapping)), ROBOT)


def test_an_axis_may_do_one_thing_each_way_and_a_button_share_its_name():
    actions = (
        action("X", Action.FINE, at=-0.5),
        action("X", Action.COARSE, at=0.5),
        action("X", Action.STOP),
    )
    check_profile(profile(DeviceMapping(key="hid:1", actions=actions)), ROBOT)


def test_an_axis_that_drives_does_nothing_else():
    one = DeviceMapping(
        key="hid:1", axes=(axis("X", "x"),), actions=(action("X", Action.STOP, at=0.9),)
    )
    with pytest.raises(ProfileError, match="drives x and stop"):
        check_profile(profile(one), ROBOT)


def test_a_profile_for_another_device_says_which_and_what_is_there():
    one = profile(DeviceMapping(key="hid:046d:*", axes=(axis("X", "x"),)))
    with pytest.raises(ProfileError) as caught:
        check(one, ROBOT, [device("hid:054c:1")])
    assert "needs hid:046d:*" in str(caught.value)
    assert "connected: Stick hid:054c:1 (hid:054c:1)" in str(caught.value)
    assert "connected: nothing" in missing(one, [])


@pytest.mark.parametrize(
    ("mapping", "said"),
    [
        (DeviceMapping(key="*", axes=(axis("Rz", "z"),)), "no axis 'Rz'; it has X, Y, Z"),
        (DeviceMapping(key="*", actions=(action("9", Action.STOP),)), "no button '9'; it has Bu"),
        (DeviceMapping(key="*", actions=(action("X", Action.STOP),)), "an axis needs at = "),
        (
            DeviceMapping(key="*", actions=(action("Button 1", Action.STOP, at=0.5),)),
            "no axis 'Button 1'",
        ),
    ],
)
def test_controls_that_a_device_does_not_have_are_refused(mapping, said):
    with pytest.raises(ProfileError) as caught:
        check(profile(mapping), ROBOT, [device()])
    assert said in str(caught.value)


def test_a_full_key_goes_before_a_pattern_and_a_device_has_one_mapping():
    pattern, full = DeviceMapping(key="hid:*"), DeviceMapping(key="hid:2")
    one = profile(pattern, full, DeviceMapping(key="hid:*", seat=OperatorRole.TRAINEE))
    found = assigned(one, [device("hid:2"), device("hid:1"), device("hid:3"), device("hid:4")])
    assert found == {"hid:2": full, "hid:1": pattern, "hid:3": one.devices[2]}


@pytest.mark.parametrize(
    ("axes", "chosen"),
    [
        (("X", "Y", "Z"), ["X", "Y", "Z"]),
        (("Slider", "Rz", "Y", "X", "Hat x", "Hat y"), ["X", "Y", "Rz"]),
        (("X", "Y", "Z", "Rz", "Rx", "Ry"), ["X", "Y", "Rz"]),
        (("X", "Y", "Rx", "Ry"), ["X", "Y", "Ry"]),
        (("φ1", "φ2", "φ3", "φ4"), ["φ1", "φ2", "φ3"]),
        (("left/right",), ["left/right"]),
        (("Throttle", "Brake"), []),
        ((), []),
    ],
)
def test_any_device_has_a_default_that_fits_it(axes, chosen):
    one = device(axes=axes)
    made = default_profile(one)
    check(made, ROBOT, [one])
    assert [mapping.control for mapping in made.devices[0].axes] == chosen


@pytest.mark.parametrize(
    ("buttons", "actions"),
    [
        (("Button 1", "Button 2", "Button 3"), [Action.DEAD_MAN, Action.STOP, Action.STAGE]),
        (("0", "1"), [Action.PENETRATION, Action.STAGE]),
        (("Mode", "Start/stop penetration"), [Action.STAGE, Action.PENETRATION]),
        (("emergency_stop", "stop", "take-over"), ["emergency_stop", "stop", "take_over"]),
        (tuple(map(str, range(32))), None),
    ],
)
def test_default_buttons_do_what_they_are_called(buttons, actions):
    one = device(buttons=buttons)
    made = default_profile(one)
    check(made, ROBOT, [one])
    if actions is not None:
        assert [mapping.action for mapping in made.devices[0].actions] == actions


def test_away_is_along_y():
    inverted = [mapping.inverted for mapping in default_profile(device()).devices[0].axes]
    assert inverted == [False, True, True]
    keys = default_profile(device(source="keyboard"))
    assert not any(mapping.inverted for mapping in keys.devices[0].axes)


def test_nothing_can_be_mapped_of_a_device_without_controls():
    with pytest.raises(ProfileError, match="neither axes nor buttons"):
        default_profile(device(axes=(), buttons=()))
