"""The updated twin: a robot file with the fitted effects."""

from dataclasses import replace
from importlib import resources
from pathlib import Path

import pytest

from rotemina.sim.errors import InputError
from rotemina.sim.gap.output import make_twin_text, write_twin
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot, parse_robot
from rotemina.sim.robot_files.reading import SHIPPED_ROBOTS_PACKAGE

ROBOT = load_robot("rotemina")
FITTED = (
    AxisEffect(axis="zn", id="creep"),
    AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.1e-4, "shape": 1.0 / 1.7}),
    AxisEffect(axis="thx", id="cross_coupling", from_axis="zn", parameters={"k": 1.0 / 3.0}),
)
SHIPPED_TEXT = resources.files(SHIPPED_ROBOTS_PACKAGE).joinpath("rotemina.toml").read_text("utf-8")


@pytest.fixture(autouse=True)
def run_in_temporary_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def find_effects_of(robot, axis):
    return [effect for effect in robot.effects if effect.axis == axis]


def test_the_text_of_a_users_file_is_kept():
    user_text = (
        SHIPPED_TEXT.replace("RoTeMiNa", "Ours") + '\n[[axis.x.effect]]\nid = "backlash" # new\n'
    )
    Path("own.toml").write_text(user_text, "utf-8")
    robot = load_robot("own.toml")
    text = make_twin_text(robot, FITTED, "own.toml")
    assert text.startswith(user_text)
    twin = parse_robot(text)
    assert find_effects_of(twin, "x") == list(robot.effects)
    for axis in ("zn", "thx"):
        assert find_effects_of(twin, axis) == [effect for effect in FITTED if effect.axis == axis]
    assert replace(twin, effects=()) == replace(robot, effects=())


def test_a_shipped_robot_is_recognised_by_its_content():
    assert make_twin_text(ROBOT, FITTED).startswith(SHIPPED_TEXT)
    assert make_twin_text(ROBOT, FITTED, "rotemina") == make_twin_text(ROBOT, FITTED)


def test_a_robot_without_a_file_gets_a_new_text():
    robot = replace(ROBOT, name="nobody's")
    twin = parse_robot(make_twin_text(robot, FITTED))
    assert replace(twin, effects=()) == robot
    assert {effect.id for effect in twin.effects} == {"creep", "hysteresis", "cross_coupling"}


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('name = "RoTeMiNa"', 'name = "Other"', "(differences: name)"),
        ("mass = 0.15", "mass = 0.16", "(differences: axis zn)"),
        ("value = 0.15", "value = 0.14", "(differences: couplings)"),
    ],
)
def test_a_file_of_another_robot_is_refused(old, new, message):
    assert old in SHIPPED_TEXT
    Path("other.toml").write_text(SHIPPED_TEXT.replace(old, new), "utf-8")
    with pytest.raises(InputError) as error_info:
        make_twin_text(ROBOT, FITTED, "other.toml")
    assert message in str(error_info.value)
    assert str(error_info.value).startswith("other.toml: this file does not describe")


def test_an_existing_file_is_not_overwritten():
    Path("twin.toml").write_text("mine", "utf-8")
    with pytest.raises(InputError, match=r"^twin\.toml already exists"):
        write_twin("new", "twin.toml")
    assert Path("twin.toml").read_text("utf-8") == "mine"
    write_twin("new", "other.toml")
    assert Path("other.toml").read_text("utf-8") == "new"
