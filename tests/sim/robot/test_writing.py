"""Robot files written: what reads back, what is kept, and what is refused."""

from dataclasses import replace
from math import nextafter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.robot.errors import RobotFileError
from rotemina.sim.robot.file import load_robot, parse_robot, shipped_robots
from rotemina.sim.robot.model import (
    AxisEffect,
    Coupling,
    KeepOut,
    Microscope,
    Reference,
    ReferenceNoise,
    Robot,
    Sensor,
    StepperAxis,
    Tool,
)
from rotemina.sim.robot.writing import robot_text, with_effects, write_robot
from rotemina.sim.whole_files import FileWriteError

WIDE = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.1e-4})
LATE = AxisEffect(axis="thx", id="delay", parameters={"delay": 2e-3}, enabled=False)
SOFT = AxisEffect(
    axis="z", id="flexible_mode", formulation="appendage", parameters={"frequency": 80.0}
)
FILE = """# a machine of two axes
[robot]
name = "two"
axes = ["a", "b"]   # a comes first

[axis.b]
kind = "stepper"
range = [0.0, 1.0]
static = true

[axis.a]
kind = "stepper"
range = [0.0, 1.0]
static = true

[[axis.a.effect]]
id = "delay"
delay = 0.003

[keep_out]
floor = 0.5
"""


@pytest.mark.parametrize("name", shipped_robots())
def test_shipped_robots_come_back(name):
    robot = load_robot(name)
    assert parse_robot(robot_text(robot)) == robot


def test_effects_come_back_in_the_order_of_their_axis():
    robot = replace(load_robot("rotemina"), effects=(WIDE, SOFT, LATE))
    assert parse_robot(robot_text(robot)).effects == (SOFT, WIDE, LATE)
    assert parse_robot(robot_text(robot)) == replace(robot, effects=(SOFT, WIDE, LATE))


def test_the_axis_that_an_effect_comes_from_comes_back():
    leak = AxisEffect(axis="zn", id="cross_coupling", from_axis="z", parameters={"k": 0.5})
    robot = replace(load_robot("rotemina"), effects=(leak,))
    assert parse_robot(robot_text(robot)).effects == (leak,)


def test_a_robot_with_everything_comes_back():
    plain = StepperAxis(kind="stepper", range=(-0.0, 1e-05), mass=1e16, damping=0.0, stiffness=3.0)
    robot = Robot(
        name='π "quoted" \\ \x7f\n',
        axes={
            "ä": replace(plain, sensor=Sensor(kind="a\tb", resolution=5e-324)),
            "b": replace(plain, unit="rad", offset=-0.1, max_speed=0.1 + 0.2),
        },
        stages={"the first": ("b", "ä")},
        couplings=(Coupling(matrix="C", axes=("ä", "b"), value=-1e-7),),
        pin_length=0.1,
        piezo_lever_arm=1 / 3,
        reference=Reference(noise_rms=ReferenceNoise(angular=0.0)),
        tool=Tool(approach_angle=-0.0),
        microscope=Microscope(optical_axis=(0.0, 0.0, 1.0), pixel_size=2.4e-6),
        keep_out=KeepOut(floor=-1e-3, objective=0.0),
    )
    assert parse_robot(robot_text(robot)) == robot


@given(width=st.floats(min_value=0.0, max_value=2e-4, allow_subnormal=True))
def test_every_number_comes_back_to_its_last_bit(width):
    odd = replace(WIDE, parameters={"width": nextafter(width, 1.0)})
    robot = replace(load_robot("rotemina"), effects=(odd,))
    (back,) = parse_robot(robot_text(robot)).effects
    assert back.parameters["width"].hex() == odd.parameters["width"].hex()


def test_a_number_that_is_not_finite_is_refused():
    bad = replace(WIDE, parameters={"width": float("nan")})
    with pytest.raises(EffectError, match="width = nan"):
        robot_text(replace(load_robot("rotemina"), effects=(bad,)))


def test_a_robot_that_no_file_can_hold_is_refused():
    robot = replace(load_robot("rotemina"), stages={"micro": ("x", "nowhere")})
    with pytest.raises(RobotFileError, match="nowhere"):
        robot_text(robot)


def test_added_effects_stand_behind_those_of_the_file():
    more = AxisEffect(axis="a", id="backlash", parameters={"width": 0.1})
    first = AxisEffect(axis="b", id="delay")
    text = with_effects(FILE, (more, first))
    assert text.startswith(FILE)
    old = AxisEffect(axis="a", id="delay", parameters={"delay": 0.003})
    assert sorted(parse_robot(text).effects, key=lambda e: e.axis) == [old, more, first]


def test_without_effects_the_text_stays():
    assert with_effects(FILE, ()) == FILE


def test_adding_refuses_what_does_not_fit_the_robot():
    with pytest.raises(EffectError, match="no such axis"):
        with_effects(FILE, (WIDE,))
    with pytest.raises(RobotFileError, match=r"mine\.toml: not valid"):
        with_effects("[", (), source="mine.toml")


def test_a_file_whose_effects_are_written_in_line_is_not_spoilt():
    start, end = FILE.split('\n[[axis.a.effect]]\nid = "delay"\ndelay = 0.003\n')
    text = f'{start}effect = [{{id = "delay"}}]\n{end}'
    with pytest.raises(RobotFileError, match="sections of their own"):
        with_effects(text, (AxisEffect(axis="a", id="delay"),))


def test_a_file_that_is_there_is_kept_unless_asked(tmp_path):
    path = tmp_path / "robot.toml"
    path.write_text("mine")
    robot = replace(load_robot("rotemina"), effects=(WIDE,))
    with pytest.raises(FileWriteError, match="already exists"):
        write_robot(robot, path)
    assert path.read_text() == "mine"
    write_robot(robot, path, overwrite=True)
    assert load_robot(path) == robot
    assert [item.name for item in tmp_path.iterdir()] == ["robot.toml"]
