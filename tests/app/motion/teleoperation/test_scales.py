"""Scales: what an impedance cannot do is said in the numbers that an operator has typed."""

import re
from dataclasses import replace

import pytest

from rotemina.app.motion.teleoperation.frames import Coordinate
from rotemina.app.motion.teleoperation.reference import Bounds, ScalingError
from rotemina.app.motion.teleoperation.scales import LawKind, Scale

TABLE = Coordinate("x", "m", Bounds(0.0, 0.055, 0.01, 0.2), 0.0275)
SCALE = Scale.preset(TABLE)
UNITS = {"µm": 1e-6, "mm": 1e-3, "µm/s": 1e-6, "mm/s": 1e-3, "Hz": 1.0, "s": 1.0}


def numbers_of(error):
    """The two bounds at the end of a message, SI."""
    told = str(error.value).partition("; use ")[2]
    return [
        float(n) * UNITS[unit] for n, unit in re.findall(r"at (?:most|least) (\S+) ([^,]+)", told)
    ]


@pytest.mark.parametrize("gain", [0.0, 0.5])
@pytest.mark.parametrize(
    ("wrong", "fields"),
    [
        ({"speed": 0.01, "time_constant_s": 0.05}, ("speed", "time_constant_s")),
        ({"way": 0.02, "spring_hz": 3.0, "damping_ratio": 0.3}, ("way", "spring_hz")),
        ({"way": 0.02, "spring_hz": 3.0, "damping_ratio": 2.0}, ("way", "spring_hz")),
    ],
)
def test_each_of_the_bounds_that_are_told_is_allowed_and_hardly_more(wrong, fields, gain):
    scale = replace(SCALE, contact_gain=gain, **wrong)
    with pytest.raises(ScalingError, match=r"x: .* more than the axes can accelerate") as error:
        scale.law(LawKind.IMPEDANCE, TABLE, 0.0)
    bounds = numbers_of(error)
    assert len(bounds) == 2
    for name, bound in zip(fields, bounds, strict=True):
        replace(scale, **{name: bound}).law(LawKind.IMPEDANCE, TABLE, 0.0)
        beyond = bound * (0.985 if name == "time_constant_s" else 1.015)
        with pytest.raises(ScalingError):
            replace(scale, **{name: beyond}).law(LawKind.IMPEDANCE, TABLE, 0.0)


def test_a_coarser_factor_is_told_as_it_acts():
    law = replace(SCALE, speed=0.004).law(LawKind.IMPEDANCE, TABLE, 0.0)
    assert law.acting_factor == 1.0
    law.rescale(2.0)
    assert law.acting_factor == 2.0
    law.rescale(10.0)
    assert law.acting_factor == pytest.approx(4.0)  # 0.8 of the acceleration, 16 mm/s in 0.2 s
