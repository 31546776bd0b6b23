"""Effects on the axes of a robot: what a robot file may say of them, and what is refused."""

import re
from dataclasses import replace

import pytest

from rotemina.sim.effects.attachment import Attached, attached_effects, parse_effect
from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.facts import Facts
from rotemina.sim.robot.errors import RobotFileError
from rotemina.sim.robot.file import load_robot, parse_robot
from rotemina.sim.robot.model import AxisEffect

ROBOT = load_robot("rotemina")

STATIC = """
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


def test_an_imperfect_robot_is_one_file():
    robot = parse_robot(
        STATIC
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
    assert [(e.axis, e.id, e.enabled) for e in robot.effects] == [
        ("p", "hysteresis", True),
        ("p", "delay", False),
        ("q", "backlash", True),
    ]
    assert [one.asked.id for one in attached_effects(robot)] == ["hysteresis", "backlash"]


def test_a_value_just_beyond_a_bound_is_told_from_it():
    width = 0.5 * ROBOT.axes["thx"].span * (1.0 + 1e-8)
    asked = AxisEffect(axis="thx", id="hysteresis", parameters={"width": width})
    with pytest.raises(EffectError) as refused:
        Attached.of(ROBOT, asked)
    told, high = re.search(
        r"width = (\S+): must be between 0 and (\S+) ", str(refused.value)
    ).groups()
    assert float(told) == width > float(high)


def test_parameters_left_out_have_their_preset_in_terms_of_the_axis():
    one = Attached.of(ROBOT, AxisEffect(axis="thx", id="hysteresis", parameters={"shape": 2.0}))
    assert one.values["shape"] == 2.0
    assert one.values["width"] == pytest.approx(0.1 * ROBOT.axes["thx"].span)


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
        ('id = "hysteresis"\nfrom_axis = "q"', ["from_axis = 'q'", "remove it"]),
        ('id = "hysteresis"\nenabled = 1', ["enabled = 1", "true or false"]),
        ('id = "histeresis"', ["no effect 'histeresis'"]),
        ("width = 1e-6", ["axis.p.effect.id = None"]),
        ('id = "backlash"', ["axis.p.effect backlash", "stepper", "kind 'piezo'"]),
        ('id = "flexible_mode"\nfrequency = 0.0', ["frequency = 0", "Hz"]),
    ],
)
def test_a_robot_file_refuses_what_cannot_be(table, words):
    with pytest.raises(RobotFileError) as refusal:
        parse_robot(f"{STATIC}\n[[axis.p.effect]]\n{table}\n", source="mine.toml")
    for word in ["mine.toml", *words]:
        assert word in str(refusal.value)


def test_effects_are_a_list_of_tables():
    with pytest.raises(RobotFileError, match=r"\[\[axis.p.effect\]\]"):
        parse_robot(STATIC + '\n[axis.p.effect]\nid = "delay"\n')


def test_an_effect_on_dynamics_needs_an_axis_that_has_some():
    robot = parse_robot(
        STATIC.replace('kind = "stepper"', 'kind = "stepper"\nstatic = true').replace(
            "mass = 40.0\ndamping = 8485.0\nstiffness = 2.0e7\n", ""
        )
    )
    with pytest.raises(EffectError, match=r"axis\.q\.effect friction.*static"):
        Attached.of(robot, AxisEffect(axis="q", id="friction"))


def test_an_unknown_axis_is_named():
    with pytest.raises(EffectError, match=r"axis\.w\.effect delay: the robot has no such axis"):
        Attached.of(ROBOT, AxisEffect(axis="w", id="delay"))


def test_a_bound_itself_is_allowed():
    high = 0.5 * ROBOT.axes["thx"].span
    Attached.of(ROBOT, AxisEffect(axis="thx", id="hysteresis", parameters={"width": high}))


def test_an_open_upper_bound_leaves_the_lower_one_closed():
    asked = AxisEffect(axis="x", id="friction", parameters={"viscous_forward": -1.0})
    with pytest.raises(EffectError, match=r"viscous_forward = -1: must be between 0 and inf"):
        Attached.of(ROBOT, asked)


def test_parsing_keeps_what_is_written():
    asked = parse_effect("thx", {"id": "delay", "delay": 1, "enabled": False})
    assert asked == AxisEffect(axis="thx", id="delay", parameters={"delay": 1.0}, enabled=False)


def test_facts_of_the_shipped_axes():
    x, thx = (Facts.of(ROBOT.axes[name]) for name in ("x", "thx"))
    assert x.pitch == 1e-3
    assert x.full_step == 5e-6
    assert x.frequency_hz == pytest.approx(112.5, rel=1e-3)
    assert thx.frequency_hz == pytest.approx(300.0, rel=1e-3)
    assert thx.input_span == 130.0
    assert thx.unit == "rad"


def test_a_negative_gain_turns_no_range_over():
    piezo = replace(
        parse_robot(STATIC).axes["p"], gain=-1.253e-5, range=(-4.65e-5, 0.0), voltage_range=None
    )
    facts = Facts.of(piezo)
    assert 0.0 <= facts.input_low < facts.input_high


def test_a_formulation_may_need_one_kind_of_axis():
    with pytest.raises(EffectError, match=r"backlash as 'screw': acts on axes of kind stepper"):
        Attached.of(load_robot("emps"), AxisEffect(axis="q", id="backlash", formulation="screw"))
