"""Writing of robot files: restored robots, kept files and refusals."""

from dataclasses import replace
from math import nextafter

import pytest
from hypothesis import given, strategies as st

from rotemina.sim.errors import EffectError, FileWriteError, RobotFileError
from rotemina.sim.robot import (
    AxisCoupling,
    AxisEffect,
    KeepOut,
    ReferenceSensor,
    Robot,
    RobotMicroscope,
    RobotTool,
    StepperAxis,
)
from rotemina.sim.robot.model import AxisSensor, ReferenceNoise
from rotemina.sim.robot_files import (
    format_robot,
    list_shipped_robots,
    load_robot,
    parse_robot,
    with_effects,
    write_robot,
)

HYSTERESIS = AxisEffect(axis="thx", id="hysteresis", parameters={"width": 1.1e-4})
DELAY = AxisEffect(axis="thx", id="delay", parameters={"delay": 2e-3}, enabled=False)
FLEXIBLE_MODE = AxisEffect(
    axis="z", id="flexible_mode", formulation="appendage", parameters={"frequency": 80.0}
)
ROBOT_TEXT = """# a machine of two axes
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


@pytest.mark.parametrize("name", list_shipped_robots())
def test_shipped_robots_can_be_read_back(name):
    robot = load_robot(name)
    assert parse_robot(format_robot(robot)) == robot


def test_effects_are_restored_in_the_order_of_their_axis():
    coupling = AxisEffect(axis="zn", id="cross_coupling", from_axis="z", parameters={"k": 0.5})
    robot = replace(load_robot("rotemina"), effects=(coupling, HYSTERESIS, FLEXIBLE_MODE, DELAY))
    assert parse_robot(format_robot(robot)) == replace(
        robot, effects=(FLEXIBLE_MODE, HYSTERESIS, DELAY, coupling)
    )


def test_a_robot_with_all_entries_can_be_read_back():
    axis = StepperAxis(kind="stepper", range=(-0.0, 1e-05), mass=1e16, damping=0.0, stiffness=3.0)
    robot = Robot(
        name='π "quoted" \\ \x7f\n',
        axes={
            "ä": replace(axis, sensor=AxisSensor(kind="a\tb", resolution=5e-324)),
            "b": replace(axis, unit="rad", offset=-0.1, max_speed=0.1 + 0.2),
        },
        stages={"the first": ("b", "ä")},
        couplings=(AxisCoupling(matrix="C", axes=("ä", "b"), value=-1e-7),),
        pin_length=0.1,
        piezo_lever_arm=1 / 3,
        reference=ReferenceSensor(noise_rms=ReferenceNoise(angular=0.0)),
        tool=RobotTool(approach_angle=-0.0),
        microscope=RobotMicroscope(optical_axis=(0.0, 0.0, 1.0), pixel_size=2.4e-6),
        keep_out=KeepOut(floor=-1e-3, objective=0.0),
    )
    assert parse_robot(format_robot(robot)) == robot


@given(width=st.floats(min_value=0.0, max_value=2e-4, allow_subnormal=True))
def test_every_number_is_restored_bit_for_bit(width):
    effect = replace(HYSTERESIS, parameters={"width": nextafter(width, 1.0)})
    robot = replace(load_robot("rotemina"), effects=(effect,))
    (restored,) = parse_robot(format_robot(robot)).effects
    assert restored.parameters["width"].hex() == effect.parameters["width"].hex()


def test_a_number_that_is_not_finite_is_refused():
    effect = replace(HYSTERESIS, parameters={"width": float("nan")})
    with pytest.raises(EffectError, match="width = nan"):
        format_robot(replace(load_robot("rotemina"), effects=(effect,)))


def test_a_robot_that_no_file_can_describe_is_refused():
    robot = replace(load_robot("rotemina"), stages={"micro": ("x", "nowhere")})
    with pytest.raises(RobotFileError, match="nowhere"):
        format_robot(robot)


def test_added_effects_follow_those_of_the_file():
    assert with_effects(ROBOT_TEXT, ()) == ROBOT_TEXT
    backlash = AxisEffect(axis="a", id="backlash", parameters={"width": 0.1})
    delay = AxisEffect(axis="b", id="delay")
    text = with_effects(ROBOT_TEXT, (backlash, delay))
    assert text.startswith(ROBOT_TEXT)
    effect_of_file = AxisEffect(axis="a", id="delay", parameters={"delay": 0.003})
    assert sorted(parse_robot(text).effects, key=lambda effect: effect.axis) == [
        effect_of_file,
        backlash,
        delay,
    ]


def test_effects_that_do_not_fit_the_robot_are_refused():
    with pytest.raises(EffectError, match="no such axis"):
        with_effects(ROBOT_TEXT, (HYSTERESIS,))
    with pytest.raises(RobotFileError, match=r"mine\.toml: not valid"):
        with_effects("[", (), source="mine.toml")


def test_adding_to_inline_effects_is_refused():
    start, end = ROBOT_TEXT.split('\n[[axis.a.effect]]\nid = "delay"\ndelay = 0.003\n')
    text = f'{start}effect = [{{id = "delay"}}]\n{end}'
    with pytest.raises(RobotFileError, match="sections of their own"):
        with_effects(text, (AxisEffect(axis="a", id="delay"),))


def test_an_existing_file_is_kept_unless_overwriting_is_requested(tmp_path):
    path = tmp_path / "robot.toml"
    path.write_text("mine")
    robot = replace(load_robot("rotemina"), effects=(HYSTERESIS,))
    with pytest.raises(FileWriteError, match="already exists"):
        write_robot(robot, path)
    assert path.read_text() == "mine"
    write_robot(robot, path, overwrite=True)
    assert load_robot(path) == robot
    assert [item.name for item in tmp_path.iterdir()] == ["robot.toml"]
