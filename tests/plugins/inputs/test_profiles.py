"""The choice of a profile: remembered, changed, kept, and what happens to a bad one."""

import pytest

from rotemina.app.motion.teleoperation.profile import (
    AxisMapping,
    DeviceMapping,
    Profile,
    ProfileError,
)
from rotemina.app.settings import Settings
from rotemina.plugins.inputs.profile_edits import Edited
from rotemina.plugins.inputs.profiles import AUTOMATIC, SETTING, ProfileChoice, plain_name

ROBOT = ("x", "y", "z", "thx", "thy", "zn")


def choice(bench, settings):
    return ProfileChoice(bench.devices, settings, ROBOT)


def driven(bench):
    bench.run()
    return {axis.drives for one in bench.devices.view.devices for axis in one.axes} - {None}


def drives(target, name="Mine"):
    axes = (AxisMapping(control="X", drives=target),)
    return Profile(name=name, devices=(DeviceMapping(key="hid:*", axes=axes),))


def write(bench, name, text):
    folder = bench.devices.keep(drives("x", "folder")).parent
    (folder / f"{name}.toml").write_text(text, "utf-8")


def test_what_was_saved_is_used_at_the_next_start(make_bench, make_stick, settings):
    bench = make_bench(make_stick())
    first = choice(bench, settings)
    assert first.begin() is None
    plugged = tuple(one.device for one in bench.devices.view.devices)
    first.edit(Edited(bench.devices.profile, plugged[0], plugged).without_axis("x"))
    assert first.changed
    assert driven(bench) == {"y", "z"}
    path = first.save("Without x")
    assert path.name == "Without x.toml"
    assert (first.chosen, first.changed) == ("Without x", False)
    bench.devices.close()

    again = make_bench(make_stick())
    second = choice(again, Settings(settings.folder / "settings.json"))
    assert second.begin() is None
    assert second.chosen == "Without x"
    assert driven(again) == {"y", "z"}
    second.choose(AUTOMATIC)
    assert settings.folder.exists()
    assert Settings(settings.folder / "settings.json").get(SETTING, "?") == AUTOMATIC


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (None, "there is no profile 'Mine' any more"),
        ("name = 'Mine'\nfoo = 1", "foo = 1: unknown key"),
        (
            "name = 'Mine'\n[[devices]]\nkey = 'a'\naxes = [{control = 'X', drives = 'q'}]",
            "'X' drives 'q', which the robot does not have",
        ),
    ],
)
def test_a_bad_or_missing_one_is_told_and_an_automatic_one_used(
    make_bench, make_stick, settings, text, said
):
    bench = make_bench(make_stick())
    if text is not None:
        write(bench, "Mine", text)
    settings.set(SETTING, "Mine")
    profiles = choice(bench, settings)
    told = profiles.begin()
    assert said in told
    assert told.endswith("An automatic profile is used instead.")
    assert profiles.chosen == AUTOMATIC
    assert bench.devices.profile.name == "Automatic"
    assert settings.get(SETTING, "") == "Mine"  # it may come back


def test_bad_ones_are_offered_with_what_is_wrong(make_bench, make_stick, settings):
    bench = make_bench(make_stick())
    bench.devices.keep(drives("x", "Good"))
    bench.devices.keep(drives("q", "Other robot"))
    write(bench, "Broken", "name =")
    offers = {offer.name: offer for offer in choice(bench, settings).look()}
    assert offers[AUTOMATIC].problem is offers["Good"].problem is None
    assert "not valid TOML" in offers["Broken"].problem
    assert "does not have" in offers["Other robot"].problem


def test_changes_are_discarded(make_bench, make_stick, settings):
    bench = make_bench(make_stick())
    profiles = choice(bench, settings)
    profiles.edit(drives("zn"))
    assert driven(bench) == {"zn"}
    profiles.discard()
    assert driven(bench) == {"x", "y", "z"}
    assert not profiles.changed


def test_changes_of_one_whose_file_has_gone_are_discarded_all_the_same(
    make_bench, make_stick, settings
):
    bench = make_bench(make_stick())
    profiles = choice(bench, settings)
    profiles.edit(drives("zn"))
    profiles.save("Mine").unlink()
    profiles.edit(drives("thx"))
    with pytest.raises(ProfileError, match="any more"):
        profiles.discard()
    assert (profiles.chosen, profiles.changed) == (AUTOMATIC, False)
    assert driven(bench) == {"x", "y", "z"}


def test_a_change_that_cannot_be_used_changes_nothing(make_bench, make_stick, settings):
    bench = make_bench(make_stick())
    profiles = choice(bench, settings)
    with pytest.raises(ProfileError, match="does not have"):
        profiles.edit(drives("q"))
    assert not profiles.changed
    assert driven(bench) == {"x", "y", "z"}


@pytest.mark.parametrize("name", ["", "../evil", "a/b", " x", "x" * 61])
def test_a_name_that_no_file_can_have_is_refused(make_bench, make_stick, settings, name):
    profiles = choice(make_bench(make_stick()), settings)
    with pytest.raises(ProfileError, match="cannot be the name of a profile"):
        profiles.save(name)


def test_without_a_profile_there_is_nothing_to_keep(make_bench, settings):
    with pytest.raises(ProfileError, match="map a control first"):
        choice(make_bench(), settings).save("Mine")


def test_a_name_is_taken_whatever_its_case(make_bench, make_stick, settings):
    bench = make_bench(make_stick())
    bench.devices.keep(drives("x", "Mine"))
    assert choice(bench, settings).exists("mine")
    assert not choice(bench, settings).exists("yours")


def test_a_name_is_suggested_that_may_be_kept(make_bench, make_stick, settings):
    bench = make_bench(make_stick())
    profiles = choice(bench, settings)
    assert profiles.suggestion() == "stick"
    profiles.save("Mine")
    assert profiles.suggestion() == "Mine"
    assert plain_name("Maker/Stick™ <3>") == "Maker Stick 3"
    assert plain_name("***") == "Profile"
