"""The fields of the scale editor: their units, and refusals that name the bound."""

from dataclasses import replace

import pytest

from rotemina.app.errors import ScalingError
from rotemina.app.motion.teleoperation import CoordinateScale, FrameCoordinate, ModeScales
from rotemina.app.motion.teleoperation.reference import CoordinateBounds
from rotemina.plugins.teleoperation.scale_fields import (
    FIELDS,
    find_field_unit,
    format_fields,
    with_entered_value,
    with_presets,
)

TABLE = FrameCoordinate("x", "m", CoordinateBounds(0.0, 0.055, 0.01, 0.2), 0.0275)
PIEZO = FrameCoordinate("zn", "m", CoordinateBounds(0.0, 65e-6, 5e-3, 5.0), 3e-5)
TILT = FrameCoordinate("thx", "rad", CoordinateBounds(0.0, 1.16e-3, 0.1, 100.0), 5e-4)
SCALE = CoordinateScale(way=5e-4, speed=1e-3, contact_gain=0.25)


def test_each_coordinate_has_units_that_fit_its_range():
    units = [
        tuple(find_field_unit(field, coordinate).unit for field in FIELDS[:2])
        for coordinate in (TABLE, PIEZO, TILT)
    ]
    assert units == [("mm", "mm/s"), ("µm", "µm/s"), ("µrad", "µrad/s")]
    assert format_fields(SCALE, TABLE) == {
        "way": "0.5",
        "speed": "1",
        "time_constant_s": "0.2",
        "spring_hz": "0",
        "damping_ratio": "1",
        "contact_gain": "25",
    }


@pytest.mark.parametrize("coordinate", [TABLE, PIEZO, TILT])
def test_typing_the_displayed_value_changes_nothing(coordinate):
    scale = CoordinateScale.make_preset(coordinate)
    texts = format_fields(scale, coordinate)
    for field in FIELDS:
        text = f" {texts[field.name]} "
        assert with_entered_value(scale, field.name, text, coordinate) is scale, field.name


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [("way", "0.25", 2.5e-4), ("speed", "2e-1", 2e-4), ("contact_gain", "100", 1.0)],
)
def test_a_typed_number_has_the_unit_of_its_field(name, text, value):
    scale = with_entered_value(SCALE, name, text, TABLE)
    assert getattr(scale, name) == pytest.approx(value)
    assert replace(scale, **{name: getattr(SCALE, name)}) == SCALE


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("way", "0", "Distance at full stick of x: 0 mm: must be above 0 mm"),
        ("way", "60", "60 mm: must be at most the range of 55 mm"),
        ("speed", "11", "11 mm/s: must be at most the maximum speed of 10 mm/s"),
        ("speed", "-1", "must be above 0 mm/s"),
        ("time_constant_s", "0.01", "0.01 s: must be at least 0.02 s"),
        ("time_constant_s", "0.02", "x: 1 mm/s within a time constant of 0.02 s .* at least 0.025"),
        ("spring_hz", "5.1", "must be at most 5 Hz"),
        ("contact_gain", "101", "101 %: must be at most 100 %"),
        ("way", "0,5", "'0,5' is not a number; enter one in mm with a decimal point"),
        ("damping_ratio", "", "'' is not a number; enter one with a decimal point"),
        ("way", "nan", "'nan' is not a number"),
    ],
)
def test_an_invalid_value_is_refused_with_its_bound(name, text, message):
    with pytest.raises(ScalingError, match=message):
        with_entered_value(SCALE, name, text, TABLE)


def test_presets_are_restored_for_one_mode_only():
    scales = ModeScales().with_scale("micro", "x", SCALE).with_scale("nano", "zn", SCALE)
    assert set(with_presets(scales, "micro").modes) == {"nano"}
    assert with_presets(scales, "micro").find_scale("micro", TABLE) == CoordinateScale.make_preset(
        TABLE
    )
