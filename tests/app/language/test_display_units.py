"""Displayed units and digits."""

import pytest

from rotemina.app.language import (
    choose_axis_scale,
    format_duration,
    format_file_size,
    get_axis_label,
    group_axes_by_stage,
    make_step_presets,
)
from rotemina.sim.robot_files import load_robot, parse_robot

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize(
    ("axis", "value", "text"),
    [("x", 0.0275, "27.5000 mm"), ("thx", 5.81775e-4, "581.8 µrad"), ("zn", 3.25e-5, "32.500 µm")],
)
def test_digits_follow_the_sensor(axis, value, text):
    assert choose_axis_scale(ROBOT.axes[axis]).format_with_unit(value) == text


def test_axes_without_a_stage_are_shown_too():
    assert list(group_axes_by_stage(ROBOT)) == ["micro", "nano"]
    assert group_axes_by_stage(load_robot("fsm")) == {"axes": ("m1", "m2", "m3")}
    text = "[robot]\nname='r'\naxes=['a','b']\nstages.s=['b']\n" + "".join(
        f"[axis.{n}]\nkind='piezo'\nrange=[0,1]\ngain=1\nstatic=true\n" for n in "ab"
    )
    assert group_axes_by_stage(parse_robot(text)) == {"s": ("b",), "axes": ("a",)}


def test_steps_go_from_fine_to_a_tenth_of_the_range():
    steps = make_step_presets("m", 0.055)
    assert steps[0] == 1e-8
    assert steps[-1] == pytest.approx(1e-3)
    assert make_step_presets("rad", 1.16e-3) == pytest.approx((1e-6, 1e-5, 1e-4))
    assert len(make_step_presets("m", 1e-9)) == 1


def test_axis_labels_are_written_as_operators_do():
    assert get_axis_label("thx") == "θx"
    assert get_axis_label("m1") == "m1"


@pytest.mark.parametrize(
    ("seconds", "decimals", "text"),
    [
        (0.3, 1, "0:00.3"),
        (59.999, 0, "0:59"),
        (3599.99, 1, "59:59.9"),
        (90_000.25, 2, "25:00:00.25"),
    ],
)
def test_a_duration_is_written_like_a_clock_and_rounded_down(seconds, decimals, text):
    assert format_duration(seconds, decimals) == text


@pytest.mark.parametrize(
    ("size", "text"),
    [(0, "0 bytes"), (999, "999 bytes"), (1000, "1 kB"), (2_345_678, "2.35 MB"), (10**13, "10 TB")],
)
def test_sizes_have_three_digits(size, text):
    assert format_file_size(size) == text
