import re
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from rotemina.app.errors import InputProfileError
from rotemina.app.motion.inputs import (
    ActionMapping,
    AxisMapping,
    DeviceMapping,
    InputProfile,
    OperatorAction,
    OperatorRole,
    check_profile,
)
from rotemina.app.motion.inputs.profile import (
    list_profiles,
    load_profile,
    save_profile,
)
from rotemina.sim.errors import FileWriteError

TEXT = st.text(st.characters(codec="utf-8", exclude_categories=("Cs",)), min_size=1, max_size=20)
PROFILES = st.builds(
    InputProfile,
    name=st.from_regex(r"[A-Za-z0-9][A-Za-z0-9 ().,+-]{0,20}[A-Za-z0-9]", fullmatch=True),
    devices=st.lists(
        st.builds(
            DeviceMapping,
            key=TEXT,
            seat=st.sampled_from(OperatorRole),
            axes=st.lists(
                st.builds(AxisMapping, control=TEXT, drives=TEXT, inverted=st.booleans())
            ).map(tuple),
            actions=st.lists(
                st.builds(
                    ActionMapping,
                    control=TEXT,
                    action=st.sampled_from(OperatorAction),
                    at=st.none() | st.floats(0.1, 1) | st.floats(-1, -0.1),
                    hysteresis=st.floats(0, 0.5),
                )
            ).map(tuple),
        ),
        min_size=1,
        max_size=3,
    ).map(tuple),
)
DEVICE = 'name = "a"\n[[devices]]\nkey = "k"\n'
ACTION = f'{DEVICE}[[devices.actions]]\ncontrol = "1"\n'
PROFILE = InputProfile(
    name="Bench", devices=(DeviceMapping(key="a", axes=(AxisMapping(control="X", drives="x"),)),)
)


@settings(max_examples=25)
@given(PROFILES)
def test_a_saved_profile_reads_back(tmp_path_factory, profile):
    folder = tmp_path_factory.mktemp("profiles")
    assert load_profile(save_profile(folder / "new", profile)) == profile


def test_a_folder_lists_good_and_bad_profiles(tmp_path):
    save_profile(tmp_path, PROFILE)
    (tmp_path / "Odd.toml").write_text("name = 1")
    (tmp_path / "notes.txt").write_text("")
    (tmp_path / ".Bench.toml.1.part").write_text("")
    good, bad = list_profiles(tmp_path)
    assert (good.path.name, good.profile, good.problem) == ("Bench.toml", PROFILE, None)
    assert bad.profile is None
    assert "Odd.toml: name = 1: must be text" in bad.problem
    assert list_profiles(tmp_path / "none") == ()


def test_saving_replaces_the_file_unless_it_fails(tmp_path, monkeypatch):
    save_profile(tmp_path, PROFILE)
    other = InputProfile(name="Bench", devices=(DeviceMapping(key="b"),))
    path = save_profile(tmp_path, other)

    def raise_disk_full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", raise_disk_full)
    with pytest.raises(FileWriteError, match="No space left"):
        save_profile(tmp_path, PROFILE)
    assert load_profile(path) == other
    assert len(list_profiles(tmp_path)) == 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "name: missing; the file needs it (and 1 more)"),
        ('name = "a"\ndevices = []', "devices = []: must have at least 1 entry"),
        ('name = "../a"\n[[devices]]\nkey = "k"', "name = '../a': it must begin with"),
        ('name = "a."\n[[devices]]\nkey = "k"', "name = 'a.': it must begin with"),
        ('name = "a"\n[[devices]]\nkey = ""', "devices[0].key = '': must not be empty"),
        (
            f'{DEVICE}[[devices.axes]]\ncontrol = "X"\ndrive = "x"',
            "devices[0].axes[0].drive = 'x': unknown key; did you mean 'drives'?",
        ),
        (
            f'{ACTION}action = "jump"',
            "devices[0].actions[0].action = 'jump': must be 'stop', 'emergency_stop'",
        ),
        (
            f'{ACTION}action = "stop"\nat = 0.05',
            "devices[0].actions[0]: at = 0.05: must be at least 0.1, or at most -0.1",
        ),
    ],
)
def test_bad_profiles_are_explained(tmp_path, text, message):
    path = tmp_path / "bench.toml"
    with pytest.raises(InputProfileError, match=r"bench\.toml cannot be read \(file not found"):
        load_profile(path)
    path.write_text(text, "utf-8")
    with pytest.raises(InputProfileError) as caught:
        load_profile(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert message in str(caught.value)


def test_the_example_of_the_documentation_can_be_used(tmp_path):
    page = Path(__file__).parents[4] / "docs" / "input-mapping.md"
    examples = re.findall(r"```toml\n(.*?)```", page.read_text("utf-8"), re.S)
    (example,) = (text for text in examples if "[[devices]]" in text)
    path = tmp_path / "example.toml"
    path.write_text(example, "utf-8")
    check_profile(load_profile(path), ("x", "y", "z", "thx", "thy", "zn"))


def test_the_documentation_names_every_key_and_action():
    page = (Path(__file__).parents[4] / "docs" / "input-mapping.md").read_text("utf-8")
    keys = {"name", "devices", *DeviceMapping.__dataclass_fields__}
    keys |= {*AxisMapping.__dataclass_fields__, *ActionMapping.__dataclass_fields__}
    missing = [word for word in (*sorted(keys), *OperatorAction) if f"`{word}`" not in page]
    assert missing == []
