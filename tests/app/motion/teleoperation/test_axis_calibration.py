import logging
import re
from math import nan
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from pydantic import ValidationError

from rotemina.app.motion.teleoperation.axis_calibration import (
    SMALLEST_WAY,
    AxisCalibration,
    Calibration,
    CalibrationError,
    CalibrationFolder,
)
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.sim.whole_files import FileWriteError

STICK = InputIdentity("hid:046d:c215:0001", "Stick", "hid")
RAW = st.floats(-1, 1)


@st.composite
def calibrations(draw):
    low, centre, high = sorted(draw(st.tuples(RAW, RAW, RAW)))
    side = draw(st.sampled_from(["both", "low", "high"]))
    low, high = (centre if side == "high" else low), (centre if side == "low" else high)
    sides = [length for length in (centre - low, high - centre) if length > 0]
    assume(sides and min(sides) >= 0.001 + SMALLEST_WAY)
    dead_zone = draw(st.floats(0.001, min(min(sides) - SMALLEST_WAY, 0.5)))
    assume(min(sides) >= dead_zone + SMALLEST_WAY)
    return AxisCalibration(
        low=low,
        centre=centre,
        high=high,
        dead_zone=dead_zone,
        expo=draw(st.floats(0, 1)),
        inverted=draw(st.booleans()),
    )


@given(calibrations(), st.floats(-0.999, 0.999))
def test_it_is_exactly_zero_in_the_dead_zone(axis, share):
    raw = axis.centre + share * axis.dead_zone
    assume(abs(raw - axis.centre) <= axis.dead_zone)
    assert axis.deflection(raw) == 0.0


@given(calibrations(), st.floats(0, 0.5))
def test_it_is_exactly_one_from_the_ends_on(axis, further):
    sign = -1.0 if axis.inverted else 1.0
    for end, side in ((axis.low, -1.0), (axis.high, 1.0)):
        one = 0.0 if end == axis.centre else sign * side
        assert axis.deflection(end) == one
        assert axis.deflection(end + side * further) == one
        assert axis.at_end(end) is (one != 0.0)


@given(calibrations(), RAW, RAW)
def test_it_is_monotone_and_never_beyond_one(axis, one, other):
    low, high = sorted((one, other))
    rise = axis.deflection(high) - axis.deflection(low)
    assert (-rise if axis.inverted else rise) >= -1e-15
    assert abs(axis.deflection(one)) <= 1.0


@given(calibrations(), RAW, st.floats(0, 1e-6))
def test_it_is_continuous(axis, raw, step):
    sides = [side for side in (axis.centre - axis.low, axis.high - axis.centre) if side > 0]
    steepest = 3.0 / (min(sides) - axis.dead_zone)  # 1 + 2 e, of the share of the way
    change = abs(axis.deflection(raw + step) - axis.deflection(raw))
    assert change <= steepest * step * (1 + 1e-6) + 1e-12


@given(st.floats(0, 1), st.floats(0.001, 0.5), RAW)
def test_the_curve_is_odd(expo, dead_zone, raw):
    axis = AxisCalibration(dead_zone=dead_zone, expo=expo)
    assert axis.deflection(-raw) == -axis.deflection(raw)


def test_the_curve_is_the_usual_mix():
    axis = AxisCalibration(dead_zone=0.2, expo=0.5)
    assert axis.deflection(0.6) == pytest.approx(0.5 * 0.5 + 0.5 * 0.5**3)


def test_a_trigger_goes_from_nought_to_one():
    trigger = AxisCalibration(low=-1.0, centre=-1.0, high=1.0, dead_zone=0.1)
    assert [trigger.deflection(raw) for raw in (-1.0, -0.91, 0.05, 1.0)] == pytest.approx(
        [0.0, 0.0, 0.5, 1.0]
    )


def test_a_number_that_is_none_moves_nothing():
    assert AxisCalibration().deflection(nan) == 0.0


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
        AxisCalibration(**values)


@pytest.fixture
def folder(tmp_path):
    return CalibrationFolder(tmp_path / "new" / "calibrations")


def test_what_is_kept_comes_back(folder):
    axes = {
        "X": AxisCalibration(low=-0.98, centre=0.013, high=1 / 3, expo=0.3, travel_m=0.02),
        'odd "name".é': AxisCalibration(inverted=True),
    }
    kept = Calibration(device=STICK.key, axes=axes)
    folder.save(STICK, kept)
    assert folder.read(STICK) == kept
    assert CalibrationFolder(folder.path(STICK).parent).load(STICK) == kept


def test_devices_have_files_of_their_own(folder):
    keys = ["a:b", "a/b", "a_b", "A:b", "..", "", "x" * 500]
    paths = {folder.path(InputIdentity(key, "", "hid")) for key in keys}
    assert len({str(path).casefold() for path in paths}) == len(keys)
    assert all(path.parent == folder.path(STICK).parent for path in paths)


def test_a_device_without_a_file_has_the_defaults(folder):
    assert folder.load(STICK).axis("X") == AxisCalibration()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("device = 3", "device = 3: must be text"),
        ("axes = {}", "device: missing"),
        ('device = "hid:046d:c215:0001"\n[axes.X]\nexpo = 2', "axes.X.expo = 2: must be at most 1"),
        ('device = "hid:046d:c215:0001"\n[axes.X]\nexpo = "1"', "axes.X.expo = '1': must be a num"),
        ('device = "hid:046d:c215:0001"\n[axes.X]\nlow = nan', "axes.X.low = nan: must be a finit"),
        (
            'device = "hid:046d:c215:0001"\n[axes.X]\nexp = 1',
            "axes.X.exp = 1: unknown key; did you",
        ),
        (
            'device = "hid:046d:c215:0001"\n[axes.X]\nlow = 0.5',
            "axes.X: low 0.5, centre 0 and high",
        ),
        ('device = "hid:046d:c215:0001"\naxes = 1', "axes = 1: must be a table"),
        ('device = "hid:other"', "device = 'hid:other': this is the file of 'hid:046d:c215:0001'"),
        ("device = ", "not valid TOML"),
        ("x = " + "[" * 5000, "TOML"),
        ("\xff", "not valid TOML"),
    ],
)
def test_a_bad_file_is_explained_and_blocks_nothing(folder, caplog, text, said):
    path = folder.path(STICK)
    path.parent.mkdir(parents=True)
    path.write_text(text, "utf-8")
    with pytest.raises(CalibrationError) as caught:
        folder.read(STICK)
    if "[[[" not in text:
        assert said in str(caught.value)
    assert str(path) in str(caught.value)
    with caplog.at_level(logging.WARNING):
        assert folder.load(STICK) == Calibration(device=STICK.key)
    assert "uncalibrated" in caplog.text


def test_bytes_and_folders_in_place_of_a_file_block_nothing(folder):
    path = folder.path(STICK)
    path.mkdir(parents=True)
    assert folder.load(STICK) == Calibration(device=STICK.key)
    path.rmdir()
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(CalibrationError, match="UTF-8"):
        folder.read(STICK)
    path.write_bytes(b"#" * 1_000_001)
    with pytest.raises(CalibrationError, match="larger than 1000000 bytes"):
        folder.read(STICK)


def test_where_nothing_can_be_written_it_is_said(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(FileWriteError, match="folder cannot be created"):
        CalibrationFolder(tmp_path / "file").save(STICK, Calibration(device=STICK.key))


def test_another_devices_calibration_is_not_kept(folder):
    with pytest.raises(CalibrationError, match="'other' cannot be stored for 'hid:046d"):
        folder.save(STICK, Calibration(device="other"))


def test_the_example_of_the_documentation_can_be_used(folder):
    page = (Path(__file__).parents[4] / "docs" / "input-mapping.md").read_text("utf-8")
    (example,) = re.findall(r"```toml\n(device = .*?)```", page, re.S)
    path = folder.path(STICK)
    path.parent.mkdir(parents=True)
    path.write_text(example, "utf-8")
    assert folder.read(STICK).axis("X").travel_m == 0.02
    keys = AxisCalibration.__dataclass_fields__
    assert [key for key in ("device", *keys) if f"`{key}`" not in page] == []
