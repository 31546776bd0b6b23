"""Calibration files are strict and dated, and one per axis can be active."""

from datetime import UTC, datetime

import numpy as np
import pytest

from rotemina.app.calibration import (
    CALIBRATION_FORMAT,
    CalibrationStore,
    SourceRecord,
    format_summary,
    make_calibration_file,
    make_source_record,
    to_json,
)
from rotemina.app.motion.device import SensorCorrections
from rotemina.sim.calibration import SensorCalibration, SensorFigureEstimate, SensorModel
from rotemina.sim.calibration.iso230 import compute_positioning
from rotemina.sim.errors import SensorCalibrationError
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot_files import load_robot

SOURCE = SourceRecord(name="zn.csv", digest="0123456789abcdef")
MORNING, NOON = datetime(2026, 11, 3, 8, tzinfo=UTC), datetime(2026, 11, 3, 12, tzinfo=UTC)


@pytest.fixture
def robot():
    return load_robot("rotemina")


@pytest.fixture
def store(tmp_path, robot):
    return CalibrationStore(tmp_path, robot)


def make_calibration(after_rms=1e-8, gain=0.02):
    model = SensorModel(low=0.0, high=6.5e-5, offset=1e-9, gain_error=gain, bend=(5e-7, -1e-7))
    table = compute_positioning(np.random.default_rng(1).normal(0.0, 1e-7, (5, 5, 2)))
    return SensorCalibration(
        axis="zn",
        unit="m",
        model=model,
        travel=(1e-6, 6.4e-5),
        figures=(
            SensorFigureEstimate("offset", 1e-9, 2e-10, "m"),
            SensorFigureEstimate("gain error", gain, 1e-5, "1"),
            SensorFigureEstimate("its period", 2e-5, float("nan"), "m"),
        ),
        runs=5,
        before_rms=5e-7,
        after_rms=after_rms,
        position=np.zeros(1),
        before=np.zeros(1),
        after=np.zeros(1),
        reading_before=table,
        reading_after=table,
        reached=None,
        notes=("the laser was lost from 3 s to 4 s",),
    )


def test_file_round_trip(robot):
    calibration = make_calibration_file(make_calibration(), robot.name, (SOURCE,), NOON)
    parsed = CALIBRATION_FORMAT.parse(CALIBRATION_FORMAT.to_toml(calibration), "again")
    assert parsed == calibration
    assert parsed.sensor.model == make_calibration().model
    assert parsed.iso_reading_before.positioning == make_calibration().reading_before
    assert parsed.name.startswith("2026-11-03T12:00:00")
    assert (
        parsed.name
        != make_calibration_file(make_calibration(gain=0.03), robot.name, (SOURCE,), NOON).name
    )


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("gain_error = 0.02", "gain_error = -1.0", "gain_error = -1.0: must be greater than"),
        ("runs = 5", "runs = 5\nrun = 4", "run = 4: unknown key; did you mean 'runs'"),
        ("version = 1", "version = 2", "version = 2: must be at most 1"),
        ("0123456789abcdef", "0123", "digest"),
        ("2026-11-03T12:00:00+00:00", "yesterday", "date must be ISO 8601"),
        ("high = 6.5e-05", "high = -1.0", "low must be less than high"),
        ("after_rms = 1e-08", "after_rms = nan", "after_rms = nan: must be a finite number"),
    ],
)
def test_invalid_file_is_refused(robot, before, after, message):
    text = CALIBRATION_FORMAT.to_toml(
        make_calibration_file(make_calibration(), robot.name, (SOURCE,), NOON)
    )
    assert before in text
    with pytest.raises(SensorCalibrationError, match=message.replace("(", r"\(")):
        CALIBRATION_FORMAT.parse(text.replace(before, after), "file")


def test_calibration_without_improvement_is_refused(robot):
    with pytest.raises(
        SensorCalibrationError, match="the calibration is not better and is not used"
    ):
        make_calibration_file(make_calibration(after_rms=4.99e-7), robot.name, (SOURCE,), NOON)


def test_digest_depends_only_on_the_record_content():
    def make_record(value):
        return Record.from_signals(
            np.arange(2.0), {("x", Tap.REF): np.array([0.0, value])}, {"x": "m"}
        )

    assert (
        make_source_record(make_record(1.0), "a").digest
        == make_source_record(make_record(1.0), "b").digest
    )
    assert (
        make_source_record(make_record(1.0), "a").digest
        != make_source_record(make_record(2.0), "a").digest
    )


def test_stored_calibrations_are_listed_and_one_is_active(store, robot):
    old = store.save(make_calibration_file(make_calibration(), robot.name, (SOURCE,), MORNING))
    new = store.save(
        make_calibration_file(make_calibration(gain=0.03), robot.name, (SOURCE,), NOON)
    )
    store.select("zn", old)
    stored, problems = store.list_calibrations()
    assert [(calibration.path, calibration.on) for calibration in stored] == [
        (new, False),
        (old, True),
    ]
    assert problems == ()

    corrections = SensorCorrections(tuple(robot.axes))
    assert store.apply(corrections) == ()
    assert corrections.names == {"zn": stored[1].calibration.name}
    store.select("zn", None)
    store.apply(corrections)
    assert corrections.names == {}


def test_invalid_files_are_listed_as_problems(store, robot):
    good = store.save(make_calibration_file(make_calibration(), robot.name, (SOURCE,), NOON))
    (store.folder / "bad.toml").write_text("version = 1")
    (store.folder / "in-use.toml").write_text("axes = 3")
    stored, problems = store.list_calibrations()
    assert [calibration.path for calibration in stored] == [good]
    assert len(problems) == 2
    assert any("bad.toml" in problem for problem in problems)
    (store.folder / "in-use.toml").unlink()
    other = CALIBRATION_FORMAT.to_toml(
        make_calibration_file(make_calibration(), "another", (SOURCE,), NOON)
    )
    (store.folder / "other.toml").write_text(other)
    with pytest.raises(SensorCalibrationError, match="of robot 'another'"):
        store.select("zn", store.folder / "other.toml")


def test_summary_and_json_contain_the_figures():
    calibration = make_calibration()
    text = format_summary(calibration)
    for part in ("gain error", "2 %", "± 0.001 %", "500 nm before", "R, repeatability", "lost"):
        assert part in text
    document = to_json(calibration)
    assert document["figures"]["gain error"] == {"value": 0.02, "half_width": 1e-5, "unit": "1"}
    assert document["figures"]["its period"]["half_width"] is None
    assert document["refused"] is None
    assert set(document["iso_230_2"]) == {"reading_before", "reading_after"}
