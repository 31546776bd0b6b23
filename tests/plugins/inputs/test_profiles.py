"""The choice of a profile: remembered, edited and saved, and invalid profiles."""

import pytest

from rotemina.app.errors import InputProfileError
from rotemina.app.motion.inputs import AxisMapping, DeviceMapping, InputProfile
from rotemina.app.settings import UserSettings
from rotemina.plugins.inputs.profile_edits import ProfileEditor
from rotemina.plugins.inputs.profiles import (
    AUTOMATIC_PROFILE,
    PROFILE_KEY,
    ProfileChoice,
    make_valid_name,
)

ROBOT = ("x", "y", "z", "thx", "thy", "zn")


def make_choice(bench, settings):
    return ProfileChoice(bench.devices, settings, ROBOT)


def list_driven_targets(bench):
    bench.run()
    return {axis.drives for device in bench.devices.view.devices for axis in device.axes} - {None}


def make_profile(target, name="Mine"):
    axes = (AxisMapping(control="X", drives=target),)
    return InputProfile(name=name, devices=(DeviceMapping(key="hid:*", axes=axes),))


def write_profile_file(bench, name, text):
    folder = bench.devices.save_profile(make_profile("x", "folder")).parent
    (folder / f"{name}.toml").write_text(text, "utf-8")


def test_a_saved_profile_is_used_at_the_next_start(make_bench, make_stick, settings):
    bench = make_bench(make_stick())
    first_choice = make_choice(bench, settings)
    assert first_choice.use_last_profile() is None
    devices = tuple(view.device for view in bench.devices.view.devices)
    first_choice.use_changed_profile(
        ProfileEditor(bench.devices.profile, devices[0], devices).without_axis("x")
    )
    assert first_choice.is_changed
    assert list_driven_targets(bench) == {"y", "z"}
    path = first_choice.save("Without x")
    assert path.name == "Without x.toml"
    assert (first_choice.chosen, first_choice.is_changed) == ("Without x", False)
    bench.devices.close()

    next_bench = make_bench(make_stick())
    next_choice = make_choice(next_bench, UserSettings(settings.folder / "settings.json"))
    assert next_choice.use_last_profile() is None
    assert next_choice.chosen == "Without x"
    assert list_driven_targets(next_bench) == {"y", "z"}
    next_choice.choose_profile(AUTOMATIC_PROFILE)
    assert settings.folder.exists()
    assert (
        UserSettings(settings.folder / "settings.json").get(PROFILE_KEY, "?") == AUTOMATIC_PROFILE
    )


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        (None, "there is no profile 'Mine' any more"),
        ("name = 'Mine'\nfoo = 1", "foo = 1: unknown key"),
        (
            "name = 'Mine'\n[[devices]]\nkey = 'a'\naxes = [{control = 'X', drives = 'q'}]",
            "'X' drives 'q', which the robot does not have",
        ),
    ],
)
def test_a_bad_or_missing_profile_is_replaced_by_an_automatic_one(
    make_bench, make_stick, settings, text, problem
):
    bench = make_bench(make_stick())
    if text is not None:
        write_profile_file(bench, "Mine", text)
    settings.set(PROFILE_KEY, "Mine")
    profiles = make_choice(bench, settings)
    message = profiles.use_last_profile()
    assert problem in message
    assert message.endswith("An automatic profile is used instead.")
    assert profiles.chosen == AUTOMATIC_PROFILE
    assert bench.devices.profile.name == "Automatic"
    assert settings.get(PROFILE_KEY, "") == "Mine"  # the file may return


def test_bad_profiles_are_listed_with_their_problem(make_bench, make_stick, settings):
    bench = make_bench(make_stick())
    bench.devices.save_profile(make_profile("x", "Good"))
    bench.devices.save_profile(make_profile("q", "Other robot"))
    write_profile_file(bench, "Broken", "name =")
    options = {option.name: option for option in make_choice(bench, settings).read_options()}
    assert options[AUTOMATIC_PROFILE].problem is options["Good"].problem is None
    assert "not valid TOML" in options["Broken"].problem
    assert "does not have" in options["Other robot"].problem


def test_changes_are_discarded_even_of_a_profile_without_a_file(make_bench, make_stick, settings):
    bench = make_bench(make_stick())
    profiles = make_choice(bench, settings)
    profiles.use_changed_profile(make_profile("zn"))
    assert list_driven_targets(bench) == {"zn"}
    profiles.discard()
    assert list_driven_targets(bench) == {"x", "y", "z"}
    assert not profiles.is_changed
    profiles.use_changed_profile(make_profile("zn"))
    profiles.save("Mine").unlink()
    profiles.use_changed_profile(make_profile("thx"))
    with pytest.raises(InputProfileError, match="any more"):
        profiles.discard()
    assert (profiles.chosen, profiles.is_changed) == (AUTOMATIC_PROFILE, False)
    assert list_driven_targets(bench) == {"x", "y", "z"}


def test_an_invalid_change_changes_nothing(make_bench, make_stick, settings):
    bench = make_bench(make_stick())
    profiles = make_choice(bench, settings)
    with pytest.raises(InputProfileError, match="does not have"):
        profiles.use_changed_profile(make_profile("q"))
    assert not profiles.is_changed
    assert list_driven_targets(bench) == {"x", "y", "z"}


@pytest.mark.parametrize("name", ["", "../evil", "a/b", " x", "x" * 61])
def test_a_name_that_is_no_file_name_is_refused(make_bench, make_stick, settings, name):
    profiles = make_choice(make_bench(make_stick()), settings)
    with pytest.raises(InputProfileError, match="cannot be the name of a profile"):
        profiles.save(name)


def test_saving_without_a_profile_is_refused(make_bench, settings):
    with pytest.raises(InputProfileError, match="map a control first"):
        make_choice(make_bench(), settings).save("Mine")


def test_a_valid_name_is_suggested(make_bench, make_stick, settings):
    bench = make_bench(make_stick())
    profiles = make_choice(bench, settings)
    assert profiles.suggest_name() == "stick"
    profiles.save("Mine")
    assert profiles.has_profile("mine")  # names are not case sensitive
    assert not profiles.has_profile("yours")
    assert profiles.suggest_name() == "Mine"
    assert make_valid_name("Maker/Stick™ <3>") == "Maker Stick 3"
    assert make_valid_name("***") == "Profile"
