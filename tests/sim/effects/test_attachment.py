"""Effects on the axes of a robot: the entries that a robot file may contain, and refusals."""

import re
from dataclasses import replace

import pytest

from rotemina.sim.effects import AttachedEffect, AxisProperties, attach_effects
from rotemina.sim.errors import EffectError, RobotFileError
from rotemina.sim.robot import AxisEffect
from rotemina.sim.robot_files import load_robot, parse_robot

ROBOT = load_robot("rotemina")

ROBOT_TEXT = """
[robot]
name = "probe"
axes = ["p", "q"]
[axis.p]
kind = "piezo"
range = [0.0, 4.65e-5]
gain = 1.253e-5
static = true
[axis.q]
kind = "stepper"
range = [0.0, 0.05]
mass = 40.0
damping = 8485.0
stiffness = 2.0e7
"""


def test_a_robot_file_may_contain_effects():
    robot = parse_robot(
        ROBOT_TEXT
        + """
[[axis.p.effect]]
id = "hysteresis"
width = 4e-6
[[axis.p.effect]]
id = "delay"
delay = 0.002
enabled = false
[[axis.q.effect]]
id = "backlash"
"""
    )
    assert [(effect.axis, effect.id, effect.enabled) for effect in robot.effects] == [
        ("p", "hysteresis", True),
        ("p", "delay", False),
        ("q", "backlash", True),
    ]
    assert [attached.entry.id for attached in attach_effects(robot)] == ["hysteresis", "backlash"]


def test_the_message_shows_enough_digits_to_tell_a_value_from_its_bound():
    bound = 0.5 * ROBOT.axes["thx"].span
    effect = AxisEffect(axis="thx", id="hysteresis", parameters={"width": bound})
    AttachedEffect.of(ROBOT, effect)
    width = bound * (1.0 + 1e-8)
    effect = replace(effect, parameters={"width": width})
    with pytest.raises(EffectError) as refusal:
        AttachedEffect.of(ROBOT, effect)
    value_text, bound_text = re.search(
        r"width = (\S+): must be between 0 and (\S+) ", str(refusal.value)
    ).groups()
    assert float(value_text) == width > float(bound_text)


def test_missing_parameters_get_presets_that_depend_on_the_axis():
    attached = AttachedEffect.of(
        ROBOT, AxisEffect(axis="thx", id="hysteresis", parameters={"shape": 2.0})
    )
    assert attached.values["shape"] == 2.0
    assert attached.values["width"] == pytest.approx(0.1 * ROBOT.axes["thx"].span)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ('id = "hysteresis"\nwidth = 1.0', ["axis.p.effect hysteresis.width = 1", "2.325e-05 m"]),
        ('id = "hysteresis"\nwidth = -1e-9', ["width = -1e-09", "between 0"]),
        ('id = "hysteresis"\nwidth = nan', ["width = nan"]),
        ('id = "hysteresis"\nwidth = "1 um"', ["width = '1 um'", "must be a number"]),
        ('id = "hysteresis"\nwidth = true', ["width = True", "must be a number"]),
        ('id = "hysteresis"\nheight = 1.0', ["height", "it has width, shape"]),
        ('id = "hysteresis"\nformulation = "duhem"', ["'duhem'", "prandtl_ishlinskii"]),
        ('id = "hysteresis"\nformulation = 3', ["formulation = 3", "must be a text"]),
        ('id = "hysteresis"\nfrom_axis = "q"', ["from_axis = 'q'", "remove from_axis"]),
        ('id = "hysteresis"\nenabled = 1', ["enabled = 1", "true or false"]),
        ('id = "histeresis"', ["no effect 'histeresis'"]),
        ("width = 1e-6", ["axis.p.effect.id = None"]),
        ('id = "backlash"', ["axis.p.effect backlash", "stepper", "kind 'piezo'"]),
        ('id = "flexible_mode"\nfrequency = 0.0', ["frequency = 0", "Hz"]),
    ],
)
def test_invalid_effects_in_a_robot_file_are_refused(table, words):
    with pytest.raises(RobotFileError) as refusal:
        parse_robot(f"{ROBOT_TEXT}\n[[axis.p.effect]]\n{table}\n", source="mine.toml")
    for word in ["mine.toml", *words]:
        assert word in str(refusal.value)


def test_effects_must_be_a_list_of_tables():
    with pytest.raises(RobotFileError, match=r"\[\[axis.p.effect\]\]"):
        parse_robot(ROBOT_TEXT + '\n[axis.p.effect]\nid = "delay"\n')


def test_an_effect_on_dynamics_is_refused_on_a_static_axis():
    robot = parse_robot(
        ROBOT_TEXT.replace('kind = "stepper"', 'kind = "stepper"\nstatic = true').replace(
            "mass = 40.0\ndamping = 8485.0\nstiffness = 2.0e7\n", ""
        )
    )
    with pytest.raises(EffectError, match=r"axis\.q\.effect friction.*static"):
        AttachedEffect.of(robot, AxisEffect(axis="q", id="friction"))


def test_a_negative_gain_keeps_the_input_range_ordered():
    piezo = replace(
        parse_robot(ROBOT_TEXT).axes["p"], gain=-1.253e-5, range=(-4.65e-5, 0.0), voltage_range=None
    )
    properties = AxisProperties.of(piezo)
    assert 0.0 <= properties.input_low < properties.input_high


@pytest.mark.parametrize(
    ("robot", "effect", "message"),
    [
        (
            "rotemina",
            AxisEffect(axis="w", id="delay"),
            r"axis\.w\.effect delay: the robot has no such axis",
        ),
        (
            "rotemina",
            AxisEffect(axis="x", id="friction", parameters={"viscous_forward": -1.0}),
            "viscous_forward = -1: must be between 0 and inf",
        ),
        (
            "emps",
            AxisEffect(axis="q", id="backlash", formulation="screw"),
            "backlash as 'screw': acts on axes of kind stepper",
        ),
    ],
)
def test_an_effect_that_does_not_fit_its_axis_is_refused(robot, effect, message):
    with pytest.raises(EffectError, match=message):
        AttachedEffect.of(load_robot(robot), effect)
