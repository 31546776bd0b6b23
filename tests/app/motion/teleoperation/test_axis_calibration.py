import logging
import re
from math import nan
from pathlib import Path

import pytest
from hypothesis import assume, given, strategies as st
from pydantic import ValidationError

from rotemina.app.errors import InputCalibrationError
from rotemina.app.motion.inputs import InputAxisCalibration, InputCalibration
from rotemina.app.motion.inputs.axis_calibration import MIN_RAW_TRAVEL, InputCalibrationFolder
from rotemina.drivers.inputs import InputIdentity
from rotemina.sim.errors import FileWriteError

STICK = InputIdentity("hid:046d:c215:0001", "Stick", "hid")
RAW = st.floats(-1, 1)


@st.composite
def make_calibrations(draw):
    low, centre, high = sorted(draw(st.tuples(RAW, RAW, RAW)))
    side = draw(st.sampled_from(["both", "low", "high"]))
    low, high = (centre if side == "high" else low), (centre if side == "low" else high)
    sides = [length for length in (centre - low, high - centre) if length > 0]
    assume(sides and min(sides) >= 0.001 + MIN_RAW_TRAVEL)
    dead_zone = draw(st.floats(0.001, min(min(sides) - MIN_RAW_TRAVEL, 0.5)))
    assume(min(sides) >= dead_zone + MIN_RAW_TRAVEL)
    return InputAxisCalibration(
        low=low,
        centre=centre,
        high=high,
        dead_zone=dead_zone,
        expo=draw(st.floats(0, 1)),
        inverted=draw(st.booleans()),
    )


@given(make_calibrations(), st.floats(-0.999, 0.999))
def test_the_deflection_is_exactly_zero_in_the_dead_zone(axis, share):
    raw = axis.centre + share * axis.dead_zone
    assume(abs(raw - axis.centre) <= axis.dead_zone)
    assert axis.compute_deflection(raw) == 0.0


@given(make_calibrations(), st.floats(0, 0.5))
def test_the_deflection_is_exactly_one_at_and_beyond_the_ends(axis, excess):
    sign = -1.0 if axis.inverted else 1.0
    for end, side in ((axis.low, -1.0), (axis.high, 1.0)):
        expected = 0.0 if end == axis.centre else sign * side
        assert axis.compute_deflection(end) == expected
        assert axis.compute_deflection(end + side * excess) == expected
        assert axis.is_at_end(end) is (expected != 0.0)


@given(make_calibrations(), RAW, st.floats(0, 2))
def test_the_deflection_is_monotone_continuous_and_at_most_one(axis, raw, distance):
    sides = [side for side in (axis.centre - axis.low, axis.high - axis.centre) if side > 0]
    max_slope = 3.0 / (min(sides) - axis.dead_zone)  # 1 + 2 expo, per share of the travel
    edges = axis.centre - axis.dead_zone, axis.centre + axis.dead_zone
    for middle, step in ((raw, distance), *((edge, 1e-6) for edge in edges)):
        rise = axis.compute_deflection(middle + step) - axis.compute_deflection(middle - step)
        rise = -rise if axis.inverted else rise
        assert -1e-15 <= rise <= 2.0 * max_slope * step * (1 + 1e-6) + 1e-12
    assert abs(axis.compute_deflection(raw)) <= 1.0


def test_the_curve_mixes_linear_and_cubic_parts_and_is_odd():
    axis = InputAxisCalibration(dead_zone=0.2, expo=0.5)
    deflections = [axis.compute_deflection(raw) for raw in (0.6, -0.6)]
    assert deflections == pytest.approx([0.5 * 0.5 + 0.5 * 0.5**3, -0.5 * 0.5 - 0.5 * 0.5**3])


def test_a_trigger_goes_from_zero_to_one():
    trigger = InputAxisCalibration(low=-1.0, centre=-1.0, high=1.0, dead_zone=0.1)
    assert [trigger.compute_deflection(raw) for raw in (-1.0, -0.91, 0.05, 1.0)] == pytest.approx(
        [0.0, 0.0, 0.5, 1.0]
    )


def test_nan_moves_nothing():
    assert InputAxisCalibration().compute_deflection(nan) == 0.0


@pytest.mark.parametrize(
    "values",
    [
        {"low": 0.5, "centre": 0.0},
        {"low": 0.0, "centre": 0.0, "high": 0.0},
        {"low": -1.0, "centre": 0.95, "high": 1.0},
        {"dead_zone": 0.0},
        {"expo": 1.1},
        {"low": -1.5},
        {"high": nan},
        {"travel_m": 0.0},
        {"inverted": 1},
    ],
)
def test_impossible_axes_are_refused(values):
    with pytest.raises(ValidationError):
        InputAxisCalibration(**values)


@pytest.fixture
def folder(tmp_path):
    return InputCalibrationFolder(tmp_path / "new" / "calibrations")


def test_a_saved_calibration_reads_back(folder):
    axes = {
        "X": InputAxisCalibration(low=-0.98, centre=0.013, high=1 / 3, expo=0.3, travel_m=0.02),
        'odd "name".é': InputAxisCalibration(inverted=True),
    }
    assert folder.load_or_default(STICK).find_axis("X") == InputAxisCalibration()
    calibration = InputCalibration(device=STICK.key, axes=axes)
    folder.save(STICK, calibration)
    assert folder.read(STICK) == calibration
    other_folder = InputCalibrationFolder(folder.make_path(STICK).parent)
    assert other_folder.load_or_default(STICK) == calibration


def test_each_device_has_a_separate_file(folder):
    keys = ["a:b", "a/b", "a_b", "A:b", "..", "", "x" * 500]
    paths = {folder.make_path(InputIdentity(key, "", "hid")) for key in keys}
    assert len({str(path).casefold() for path in paths}) == len(keys)
    assert all(path.parent == folder.make_path(STICK).parent for path in paths)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("axes = {}", "device: missing"),
        (f'device = "{STICK.key}"\n[axes.X]\nexpo = 2', "axes.X.expo = 2: must be at most 1"),
        (f'device = "{STICK.key}"\n[axes.X]\nlow = nan', "axes.X.low = nan: must be a finit"),
        (f'device = "{STICK.key}"\n[axes.X]\nexp = 1', "axes.X.exp = 1: unknown key; did you"),
        (f'device = "{STICK.key}"\n[axes.X]\nlow = 0.5', "axes.X: low 0.5, centre 0 and high"),
        ('device = "hid:other"', f"device = 'hid:other': this is the file of '{STICK.key}'"),
        ("x = " + "[" * 5000, "nested more than 50 levels"),
    ],
)
def test_a_bad_file_is_explained_and_blocks_nothing(folder, caplog, text, message):
    path = folder.make_path(STICK)
    path.parent.mkdir(parents=True)
    path.write_text(text, "utf-8")
    with pytest.raises(InputCalibrationError) as caught:
        folder.read(STICK)
    assert message in str(caught.value)
    assert str(path) in str(caught.value)
    with caplog.at_level(logging.WARNING):
        assert folder.load_or_default(STICK) == InputCalibration(device=STICK.key)
    assert "uncalibrated" in caplog.text


def test_a_folder_in_place_of_a_file_blocks_nothing_and_the_reverse_is_reported(folder, tmp_path):
    folder.make_path(STICK).mkdir(parents=True)
    assert folder.load_or_default(STICK) == InputCalibration(device=STICK.key)
    (tmp_path / "file").write_text("")
    with pytest.raises(FileWriteError, match="folder cannot be created"):
        InputCalibrationFolder(tmp_path / "file").save(STICK, InputCalibration(device=STICK.key))


def test_a_calibration_of_another_device_is_not_saved(folder):
    with pytest.raises(InputCalibrationError, match="'other' cannot be stored for 'hid:046d"):
        folder.save(STICK, InputCalibration(device="other"))


def test_the_example_of_the_documentation_can_be_used(folder):
    page = (Path(__file__).parents[4] / "docs" / "input-mapping.md").read_text("utf-8")
    (example,) = re.findall(r"```toml\n(device = .*?)```", page, re.S)
    path = folder.make_path(STICK)
    path.parent.mkdir(parents=True)
    path.write_text(example, "utf-8")
    assert folder.read(STICK).find_axis("X").travel_m == 0.02
    keys = InputAxisCalibration.__dataclass_fields__
    assert [key for key in ("device", *keys) if f"`{key}`" not in page] == []
