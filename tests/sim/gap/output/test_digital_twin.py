"""The twin brought up to date: a robot file with the fitted effects."""

from dataclasses import replace
from importlib import resources
from pathlib import Path

import pytest

from rotemina.sim.errors import InputError
from rotemina.sim.gap.output.digital_twin import twin_text, write_twin
from rotemina.sim.robot.file import SHIPPED, load_robot, parse_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")
FOUND = (
    AxisEffect(axis="zn", id="creep"),
    AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.1e-4, "shape": 1.0 / 1.7}),
    AxisEffect(axis="thx", id="cross_coupling", from_axis="zn", parameters={"k": 1.0 / 3.0}),
)
SHIPPED_TEXT = resources.files(SHIPPED).joinpath("rotemina.toml").read_text("utf-8")


@pytest.fixture(autouse=True)
def in_tmp(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def effects_by_axis(robot, axis):
    return [effect for effect in robot.effects if effect.axis == axis]


def test_the_text_of_the_users_own_file_is_kept():
    own = SHIPPED_TEXT.replace("RoTeMiNa", "Ours") + '\n[[axis.x.effect]]\nid = "backlash" # new\n'
    Path("own.toml").write_text(own, "utf-8")
    robot = load_robot("own.toml")
    text = twin_text(robot, FOUND, "own.toml")
    assert text.startswith(own)
    twin = parse_robot(text)
    assert effects_by_axis(twin, "x") == list(robot.effects)
    for axis in ("zn", "thx"):
        assert effects_by_axis(twin, axis) == [one for one in FOUND if one.axis == axis]
    assert replace(twin, effects=()) == replace(robot, effects=())


def test_a_shipped_robot_is_known_by_what_it_is():
    assert twin_text(ROBOT, FOUND).startswith(SHIPPED_TEXT)
    assert twin_text(ROBOT, FOUND, "rotemina") == twin_text(ROBOT, FOUND)


def test_a_robot_without_a_file_is_written_anew():
    robot = replace(ROBOT, name="nobody's")
    twin = parse_robot(twin_text(robot, FOUND))
    assert replace(twin, effects=()) == robot
    assert {effect.id for effect in twin.effects} == {"creep", "hysteresis", "cross_coupling"}


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('name = "RoTeMiNa"', 'name = "Other"', "they differ in name;"),
        ("mass = 0.15", "mass = 0.16", "they differ in axis zn;"),
        ("value = 0.15", "value = 0.14", "they differ in couplings;"),
    ],
)
def test_a_file_of_another_robot_is_refused(old, new, message):
    assert old in SHIPPED_TEXT
    Path("other.toml").write_text(SHIPPED_TEXT.replace(old, new), "utf-8")
    with pytest.raises(InputError) as caught:
        twin_text(ROBOT, FOUND, "other.toml")
    assert message in str(caught.value)
    assert str(caught.value).startswith("other.toml: it describes another robot than the one")


def test_a_file_that_is_there_is_not_overwritten():
    Path("twin.toml").write_text("mine", "utf-8")
    with pytest.raises(InputError, match=r"^twin\.toml already exists"):
        write_twin("new", "twin.toml")
    assert Path("twin.toml").read_text("utf-8") == "mine"
    write_twin("new", "other.toml")
    assert Path("other.toml").read_text("utf-8") == "new"
