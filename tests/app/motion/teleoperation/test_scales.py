"""Scales: a refused impedance states its bounds in the operator's units."""

import re
from dataclasses import replace

import pytest

from rotemina.app.errors import ScalingError
from rotemina.app.motion.teleoperation import CoordinateScale, FrameCoordinate, LawKind
from rotemina.app.motion.teleoperation.reference import CoordinateBounds

TABLE = FrameCoordinate("x", "m", CoordinateBounds(0.0, 0.055, 0.01, 0.2), 0.0275)
SCALE = CoordinateScale.make_preset(TABLE)
UNITS = {"µm": 1e-6, "mm": 1e-3, "µm/s": 1e-6, "mm/s": 1e-3, "Hz": 1.0, "s": 1.0}


def read_bounds(error):
    """Return the two bounds at the end of a message, in SI units."""
    bounds = str(error.value).partition("; use ")[2]
    return [
        float(value) * UNITS[unit]
        for value, unit in re.findall(r"at (?:most|least) (\S+) ([^,]+)", bounds)
    ]


@pytest.mark.parametrize("gain", [0.0, 0.5])
@pytest.mark.parametrize(
    ("changes", "fields"),
    [
        ({"speed": 0.01, "time_constant_s": 0.05}, ("speed", "time_constant_s")),
        ({"way": 0.02, "spring_hz": 3.0, "damping_ratio": 0.3}, ("way", "spring_hz")),
        ({"way": 0.02, "spring_hz": 3.0, "damping_ratio": 2.0}, ("way", "spring_hz")),
    ],
)
def test_the_stated_bounds_are_allowed_and_values_just_beyond_are_not(changes, fields, gain):
    scale = replace(SCALE, contact_gain=gain, **changes)
    with pytest.raises(ScalingError, match=r"x: .* more than the axes can accelerate") as error:
        scale.make_law(LawKind.IMPEDANCE, TABLE, 0.0)
    bounds = read_bounds(error)
    assert len(bounds) == 2
    for name, bound in zip(fields, bounds, strict=True):
        replace(scale, **{name: bound}).make_law(LawKind.IMPEDANCE, TABLE, 0.0)
        excess = bound * (0.985 if name == "time_constant_s" else 1.015)
        with pytest.raises(ScalingError):
            replace(scale, **{name: excess}).make_law(LawKind.IMPEDANCE, TABLE, 0.0)


def test_a_coarser_factor_is_limited_by_the_acceleration():
    law = replace(SCALE, speed=0.004).make_law(LawKind.IMPEDANCE, TABLE, 0.0)
    assert law.effective_factor == 1.0
    law.rescale(2.0)
    assert law.effective_factor == 2.0
    law.rescale(10.0)
    assert law.effective_factor == pytest.approx(4.0)  # 0.8 of the acceleration, 16 mm/s in 0.2 s
