"""Units and digits that people see."""

import pytest

from rotemina.app.display_units import (
    axis_scale,
    duration_text,
    label,
    size_text,
    stages,
    step_presets,
)
from rotemina.sim.robot.file import load_robot, parse_robot

ROBOT = load_robot("rotemina")


@pytest.mark.parametrize(
    ("axis", "value", "text"),
    [("x", 0.0275, "27.5000 mm"), ("thx", 5.81775e-4, "581.8 µrad"), ("zn", 3.25e-5, "32.500 µm")],
)
def test_digits_follow_the_sensor(axis, value, text):
    assert axis_scale(ROBOT.axes[axis]).text(value) == text


def test_axes_without_a_stage_are_shown_too():
    assert list(stages(ROBOT)) == ["micro", "nano"]
    assert stages(load_robot("fsm")) == {"axes": ("m1", "m2", "m3")}
    text = "[robot]\nname='r'\naxes=['a','b']\nstages.s=['b']\n" + "".join(
        f"[axis.{n}]\nkind='piezo'\nrange=[0,1]\ngain=1\nstatic=true\n" for n in "ab"
    )
    assert stages(parse_robot(text)) == {"s": ("b",), "axes": ("a",)}


def test_steps_go_from_fine_to_a_tenth_of_the_range():
    steps = step_presets("m", 0.055)
    assert steps[0] == 1e-8
    assert steps[-1] == pytest.approx(1e-3)
    assert step_presets("rad", 1.16e-3) == pytest.approx((1e-6, 1e-5, 1e-4))
    assert len(step_presets("m", 1e-9)) == 1


def test_names_are_written_as_operators_do():
    assert label("thx") == "θx"
    assert label("m1") == "m1"


@pytest.mark.parametrize(
    ("seconds", "decimals", "text"),
    [
        (0.0, 0, "0:00"),
        (59.999, 0, "0:59"),
        (7.5, 1, "0:07.5"),
        (0.3, 1, "0:00.3"),
        (3599.99, 1, "59:59.9"),
        (3723.0, 0, "1:02:03"),
        (90_000.25, 2, "25:00:00.25"),
    ],
)
def test_a_duration_reads_as_on_a_clock_and_never_runs_ahead(seconds, decimals, text):
    assert duration_text(seconds, decimals) == text


@pytest.mark.parametrize(
    ("size", "text"),
    [(0, "0 bytes"), (999, "999 bytes"), (1000, "1 kB"), (2_345_678, "2.35 MB"), (10**13, "10 TB")],
)
def test_sizes_have_three_digits(size, text):
    assert size_text(size) == text
