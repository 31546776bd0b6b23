"""Calibrations as files: strict, dated, one of each axis on."""

from datetime import UTC, datetime

import numpy as np
import pytest

from rotemina.app.calibration.files import FORMAT, Source, kept, source_of
from rotemina.app.calibration.store import CalibrationStore
from rotemina.app.calibration.words import as_json, summary
from rotemina.app.motion.sensor_corrections import SensorCorrections
from rotemina.sim.calibration.errors import CalibrationError
from rotemina.sim.calibration.iso230 import positioning
from rotemina.sim.calibration.sensor import SensorModel
from rotemina.sim.calibration.sensor_calibration import Calibration, Figure
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.robot.file import load_robot

SOURCE = Source(name="zn.csv", digest="0123456789abcdef")
MORNING, NOON = datetime(2026, 11, 3, 8, tzinfo=UTC), datetime(2026, 11, 3, 12, tzinfo=UTC)


@pytest.fixture
def robot():
    return load_robot("rotemina")


@pytest.fixture
def store(tmp_path, robot):
    return CalibrationStore(tmp_path, robot)


def made(after=1e-8, gain=0.02):
    model = SensorModel(low=0.0, high=6.5e-5, offset=1e-9, gain_error=gain, bend=(5e-7, -1e-7))
    table = positioning(np.random.default_rng(1).normal(0.0, 1e-7, (5, 5, 2)))
    return Calibration(
        axis="zn",
        unit="m",
        model=model,
        travel=(1e-6, 6.4e-5),
        figures=(
            Figure("offset", 1e-9, 2e-10, "m"),
            Figure("gain error", gain, 1e-5, "1"),
            Figure("its period", 2e-5, float("nan"), "m"),
        ),
        runs=5,
        before_rms=5e-7,
        after_rms=after,
        position=np.zeros(1),
        before=np.zeros(1),
        after=np.zeros(1),
        reading_before=table,
        reading_after=table,
        reached=None,
        notes=("the laser was lost from 3 s to 4 s",),
    )


def test_a_file_says_all_of_it_again(robot):
    calibration = kept(made(), robot.name, (SOURCE,), NOON)
    again = FORMAT.parse(FORMAT.text(calibration), "again")
    assert again == calibration
    assert again.sensor.model == made().model
    assert again.iso_reading_before.figures == made().reading_before
    assert again.name.startswith("2026-11-03T12:00:00")
    assert again.name != kept(made(gain=0.03), robot.name, (SOURCE,), NOON).name


@pytest.mark.parametrize(
    ("before", "after", "said"),
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
def test_a_file_is_strict(robot, before, after, said):
    text = FORMAT.text(kept(made(), robot.name, (SOURCE,), NOON))
    assert before in text
    with pytest.raises(CalibrationError, match=said.replace("(", r"\(")):
        FORMAT.parse(text.replace(before, after), "file")


def test_one_that_is_not_better_is_not_kept(robot):
    with pytest.raises(CalibrationError, match="the calibration is not better and is not used"):
        kept(made(after=4.99e-7), robot.name, (SOURCE,), NOON)


def test_the_digest_is_of_what_a_record_holds():
    def record(value):
        return Record.from_signals(
            np.arange(2.0), {("x", Tap.REF): np.array([0.0, value])}, {"x": "m"}
        )

    assert source_of(record(1.0), "a").digest == source_of(record(1.0), "b").digest
    assert source_of(record(1.0), "a").digest != source_of(record(2.0), "a").digest


def test_stored_ones_are_listed_and_one_is_on(store, robot):
    old = store.save(kept(made(), robot.name, (SOURCE,), MORNING))
    new = store.save(kept(made(gain=0.03), robot.name, (SOURCE,), NOON))
    store.switch("zn", old)
    stored, problems = store.listed()
    assert [(one.path, one.on) for one in stored] == [(new, False), (old, True)]
    assert problems == ()

    corrections = SensorCorrections(tuple(robot.axes))
    assert store.apply(corrections) == ()
    assert corrections.names == {"zn": stored[1].calibration.name}
    store.switch("zn", None)
    store.apply(corrections)
    assert corrections.names == {}


def test_files_that_are_none_are_named_and_left_out(store, robot):
    good = store.save(kept(made(), robot.name, (SOURCE,), NOON))
    (store.folder / "bad.toml").write_text("version = 1")
    (store.folder / "in-use.toml").write_text("axes = 3")
    stored, problems = store.listed()
    assert [one.path for one in stored] == [good]
    assert len(problems) == 2
    assert any("bad.toml" in one for one in problems)
    (store.folder / "in-use.toml").unlink()
    other = FORMAT.text(kept(made(), "another", (SOURCE,), NOON))
    (store.folder / "other.toml").write_text(other)
    with pytest.raises(CalibrationError, match="of robot 'another'"):
        store.switch("zn", store.folder / "other.toml")


def test_words_and_json_hold_the_figures():
    calibration = made()
    text = summary(calibration)
    for part in ("gain error", "2 %", "± 0.001 %", "500 nm before", "R, repeatability", "lost"):
        assert part in text
    answer = as_json(calibration)
    assert answer["figures"]["gain error"] == {"value": 0.02, "half_width": 1e-5, "unit": "1"}
    assert answer["figures"]["its period"]["half_width"] is None
    assert answer["refused"] is None
    assert set(answer["iso_230_2"]) == {"reading_before", "reading_after"}
