"""The library of records: what it finds, keeps, and never loses."""

import shutil
import sqlite3
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.motion.compared_run import compared
from rotemina.app.motion.model_in_use import ModelInUse
from rotemina.app.records import file_facts, library
from rotemina.app.records.database import DamagedLibraryError, LibraryError, RecordStore
from rotemina.app.records.entry import Entry, Kind, search
from rotemina.app.records.library import Library, commands, read
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.records.writing import write_record
from rotemina.sim.robot.file import load_robot

ROBOT = load_robot("rotemina")
SAID = {
    "began": "2026-03-04T05:06:07.250+01:00",
    "robot": "RoTeMiNa",
    "robot_sha256": "abc",
    "driver": "simulator",
    "model": "nominal-1",
    "effects": "zn hysteresis",
    "run": "series 3",
    "operator": "Müller",
    "sample": "oocyte 7",
}


def made(path, said=None, *, off=1e-7, rows=200):
    """Write a record of zn, in which the reading is ``off`` by so much while it moves."""
    time_s = 0.01 * np.arange(rows)
    command = 3e-5 + 1e-5 * np.sin(time_s)
    signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): command + off}
    record = Record.from_signals(time_s, signals, {"zn": "m"}, SAID if said is None else said)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_record(record, path)
    return record


@pytest.fixture
def data(tmp_path):
    return tmp_path / "data"


def looked(folder):
    found = Library(folder)
    found.refresh()
    return found


def name_to_note(found):
    return {one.name: one.note for one in found.entries}


def test_what_lies_in_the_folders_is_found_with_all_its_file_says(data, make_recording):
    made(data / "played" / "2026-03-04_05-06-07-000250_tour.csv.gz")
    made(data / "played" / "2025-01-02_03-04-05-000006_old.csv.gz", {})  # of an older program
    make_recording(data / "recordings" / "2026-03-05_05-06-07-000000.arrows")
    (data / "played" / ".draft.part").write_text("half")
    tour, recording, old = looked(data).entries  # newest first, by the date in the file
    assert (tour.name, tour.run, tour.operator) == ("series 3: tour", "series 3", "Müller")
    assert (tour.sample, tour.effects, tour.machine) == ("oocyte 7", "zn hysteresis", "abc")
    assert tour.duration_s == pytest.approx(1.99)
    assert f"{tour.began:%H:%M:%S}" == "05:06:07"
    assert (old.name, old.began.year, old.kind) == ("old", 2025, Kind.PLAYBACK)
    assert (recording.kind, recording.robot) == (Kind.RECORDING, "RoTeMiNa")
    assert recording.duration_s == pytest.approx(1.2, abs=0.01)
    assert recording.gap.axis in ROBOT.axes
    assert recording.events >= 1


def test_a_file_that_cannot_be_read_says_why_and_keeps_nobody_from_the_others(data):
    made(data / "played" / "good.csv")
    (data / "recordings").mkdir()
    (data / "recordings" / "spoilt.arrows").write_bytes(b"nothing of ours")
    (data / "played" / "cut.csv.gz").write_bytes(b"\x1f\x8b\x08")
    problems = {one.path.name: one.problem for one in looked(data).entries}
    assert problems["good.csv"] == ""
    assert "not a recording of this program" in problems["spoilt.arrows"]
    assert "cut.csv.gz" in problems["cut.csv.gz"]


def test_nothing_is_opened_again_that_has_not_changed(data, monkeypatch):
    made(data / "played" / "good.csv")
    before = looked(data).entries
    monkeypatch.setattr(library, "with_facts", None)
    monkeypatch.setattr(library, "digest", None)
    assert looked(data).entries == before


def test_names_and_notes_are_kept_though_the_file_changes_goes_and_comes_back(data):
    path = data / "played" / "tour.csv"
    made(path)
    found = looked(data)
    found.call(found.entries[0].id, name="first try", note="the dish was dry")
    made(path, rows=300)  # somebody has written another record there
    found.refresh()
    (one,) = found.entries
    assert (one.name, one.note, one.changed) == ("first try", "the dish was dry", True)
    assert one.duration_s == pytest.approx(2.99)
    path.rename(data / "elsewhere.csv")
    found.refresh()
    assert found.entries[0].missing
    assert not found.entries[0].usable
    (data / "elsewhere.csv").rename(path)
    found.refresh()
    assert (found.entries[0].missing, found.entries[0].note) == (False, "the dish was dry")


def test_a_file_that_was_renamed_or_touched_is_the_same_one(data):
    path = data / "played" / "tour.csv"
    made(path)
    found = looked(data)
    found.call(found.entries[0].id, note="keep me")
    path.rename(path.with_name("renamed.csv"))
    path.with_name("renamed.csv").touch()
    found.refresh()
    (one,) = found.entries
    assert (one.path.name, one.note, one.changed) == ("renamed.csv", "keep me", False)


def test_the_whole_folder_can_be_moved_or_copied(data, tmp_path):
    made(data / "played" / "tour.csv")
    found = looked(data)
    found.call(found.entries[0].id, note="keep me")
    shutil.copytree(data, tmp_path / "copy", copy_function=shutil.copyfile)  # with new dates
    shutil.rmtree(data)
    (one,) = looked(tmp_path / "copy").entries
    assert one.path == tmp_path / "copy" / "played" / "tour.csv"
    assert (one.note, one.missing, one.changed) == ("keep me", False, False)


def test_files_from_elsewhere_are_found_again_together_where_one_was_moved(data, tmp_path):
    found = Library(data)
    for name in ("one.csv", "two.csv"):
        record = made(tmp_path / "stick" / name, {"run": name})
        found.add(tmp_path / "stick" / name, record, name)
    (tmp_path / "stick").rename(tmp_path / "moved")
    found.refresh()
    assert [one.missing for one in found.entries] == [True, True]
    one = next(each for each in found.entries if each.path.name == "one.csv")
    with pytest.raises(LibraryError, match="not those of the record"):
        found.found_at(one.id, tmp_path / "moved" / "two.csv")
    found.found_at(one.id, tmp_path / "moved" / "one.csv")
    assert not any(each.missing for each in found.entries)
    assert looked(data).entries == found.entries


def test_two_programs_add_and_change_without_losing_anything(data):
    first, second = Library(data), Library(data)
    for number, one in enumerate((first, second)):
        path = data / "played" / f"{number}.csv"
        one.add(path, made(path, {}), path.name)
    for one in (first, second):
        one.refresh()
    assert first.entries == second.entries
    number = next(one.id for one in first.entries if one.name == "0")
    first.call(number, note="by the first")
    second.call(number, name="by the second")
    first.refresh()
    assert name_to_note(first) == {"by the second": "by the first", "1": ""}


def test_a_crash_between_writing_and_listing_loses_no_record(data, monkeypatch):
    made(data / "played" / "a.csv")
    made(data / "played" / "b.csv")
    monkeypatch.setattr(library, "_AT_A_TIME", 1)
    seen = []

    def dies(entry):
        if seen:
            raise KeyboardInterrupt
        seen.append(entry)
        return file_facts.with_facts(entry)

    with monkeypatch.context() as patched:
        patched.setattr(library, "with_facts", dies)
        with pytest.raises(KeyboardInterrupt):
            looked(data)
    assert len(RecordStore(data).all()) == 1
    assert len(looked(data).entries) == 2


def test_a_write_that_was_cut_off_is_undone(data):
    made(data / "played" / "a.csv")
    found = looked(data)
    store = RecordStore(data)

    def entries():
        yield replace(found.entries[0], gap=None, events=9)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        store.put(entries())
    assert store.all()[0].events == 0


def test_a_damaged_file_is_set_aside_and_the_records_are_listed_anew(data):
    made(data / "played" / "a.csv")
    looked(data)
    (data / "records.sqlite3").write_bytes(b"no database at all" * 100)
    found = Library(data)
    with pytest.raises(DamagedLibraryError, match=r"kept as records\.damaged-1\.sqlite3"):
        found.refresh()
    assert [one.path.name for one in found.entries] == ["a.csv"]
    assert (data / "records.damaged-1.sqlite3").read_bytes().startswith(b"no database")


def test_a_library_of_a_newer_program_is_refused_and_left_alone(data):
    data.mkdir()
    with sqlite3.connect(data / "records.sqlite3") as base:
        base.execute("PRAGMA user_version = 7")
    base.close()
    with pytest.raises(LibraryError, match="has version 7, but this program uses 1"):
        looked(data)


def test_the_gap_is_the_one_of_the_run_with_its_model(data):
    path = data / "played" / "tour.csv"
    record = made(path, off=2e-6)
    run = compared(ModelInUse.nominal_of(Simulator(ROBOT)), "tour", record)
    found = Library(data)
    found.add(path, record, "tour.csv")
    found.set_gap(path, run, ROBOT)
    (one,) = looked(data).entries
    figure = run.gaps["zn", Tap.MEAS]
    assert (one.gap.axis, one.gap.rms, one.gap.unit) == ("zn", figure.rms, "m")
    assert one.model == run.model_id
    other = replace(run, model_id="another")
    found.set_gap(path, other, ROBOT)  # a later look by another model changes nothing
    assert looked(data).entries == (one,)


def test_deleting_takes_own_files_away_and_leaves_others(data, tmp_path):
    own, other = data / "played" / "own.csv", tmp_path / "other.csv"
    found = Library(data)
    for path in (own, other):
        found.add(path, made(path), path.name)
    found.delete({one.id for one in found.entries})
    assert found.entries == looked(data).entries == ()
    assert (own.exists(), other.exists()) == (False, True)


def test_a_record_and_a_short_recording_are_read_and_a_very_long_one_refused(
    data, make_recording, monkeypatch
):
    made(data / "played" / "tour.csv")
    make_recording(data / "recordings" / "run.arrows")
    for one in looked(data).entries:
        record = read(one, ROBOT)
        assert record.duration_s == pytest.approx(one.duration_s, abs=0.05)
    recording = next(each for each in looked(data).entries if each.kind is Kind.RECORDING)
    assert commands(recording, ROBOT, 0.01).axes == ("x",)  # alone moved, and rests at both ends
    monkeypatch.setattr(library, "MOST_ROWS", 10)
    with pytest.raises(LibraryError, match="samples are too many"):
        read(recording, ROBOT)


def test_a_search_wants_every_word_somewhere(data):
    made(data / "played" / "tour.csv")
    entries = (
        *looked(data).entries,
        Entry(path=Path("z.csv"), kind=Kind.FILE, name="plain", note="dry DISH"),
    )

    def names(*asked):
        return [one.name for one in search(entries, *asked)]

    assert names("") == ["series 3: tour", "plain"]
    assert names("müller OOCYTE") == ["series 3: tour"]
    assert names("müller dish") == []
    assert names("dish") == names("", {Kind.FILE}) == ["plain"]
    assert names("2026-03-04 hysteresis") == ["series 3: tour"]


@pytest.mark.parametrize(
    ("text", "duration_s"),
    [
        ("t [ms],x [mm]\n0,1\n# a remark\n250,1\n\n", 0.25),
        ("t [s];x [mm]\n1,5;1\n3,0;1\n", 1.5),
        ('sep=;\n% a\n"t [s]";"x [mm]"\n"1,5";"1"\n"3,0";"1"\n;\n', 1.5),
        ("t [s],x [mm]\n0,1\n", 0.0),
        ("0,1\n1,1\n", None),
        ("time,x\n0,1\n1,1\n", None),
    ],
)
def test_the_length_is_read_off_first_and_last_row(data, text, duration_s):
    path = data / "played" / "a.csv"
    path.parent.mkdir(parents=True)
    path.write_text(text)
    assert looked(data).entries[0].duration_s == duration_s
