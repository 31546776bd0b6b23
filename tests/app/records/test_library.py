"""The library of records finds records, keeps their texts and loses nothing."""

import shutil
import sqlite3
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.errors import DamagedLibraryError, LibraryError
from rotemina.app.motion.model import ModelInUse
from rotemina.app.motion.playback import compare_with_model
from rotemina.app.records import (
    LibraryEntry,
    RecordCatalogue,
    RecordKind,
    RecordStore,
    file_facts,
    library,
    read_commands,
    read_entry,
    search_entries,
)
from rotemina.drivers.simulator import Simulator
from rotemina.sim.records import Record, Tap, write_record
from rotemina.sim.robot_files import load_robot

ROBOT = load_robot("rotemina")
METADATA = {
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


def write_zn_record(path, metadata=None, *, offset=1e-7, rows=200):
    """Write a record of zn in motion whose reading has an ``offset``."""
    time_s = 0.01 * np.arange(rows)
    command = 3e-5 + 1e-5 * np.sin(time_s)
    signals = {("zn", Tap.CMD): command, ("zn", Tap.MEAS): command + offset}
    record = Record.from_signals(
        time_s, signals, {"zn": "m"}, METADATA if metadata is None else metadata
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    write_record(record, path)
    return record


@pytest.fixture
def data_folder(tmp_path):
    return tmp_path / "data"


def refresh_catalogue(folder):
    catalogue = RecordCatalogue(folder)
    catalogue.refresh()
    return catalogue


def map_names_to_notes(catalogue):
    return {entry.name: entry.note for entry in catalogue.entries}


@pytest.fixture
def tour(data_folder):
    """Path of a listed record that has a note."""
    path = data_folder / "played" / "tour.csv"
    write_zn_record(path)
    catalogue = refresh_catalogue(data_folder)
    catalogue.set_texts(catalogue.entries[0].id, name="first try", note="keep me")
    return path


def test_files_in_the_folders_are_listed_with_their_metadata(data_folder, make_recording):
    write_zn_record(data_folder / "played" / "2026-03-04_05-06-07-000250_tour.csv.gz")
    # A record of an older program has no metadata.
    write_zn_record(data_folder / "played" / "2025-01-02_03-04-05-000006_old.csv.gz", {})
    make_recording(data_folder / "recordings" / "2026-03-05_05-06-07-000000.arrows")
    (data_folder / "played" / ".draft.part").write_text("half")
    # Newest first, by the date in the file.
    tour, recording, old_playback = refresh_catalogue(data_folder).entries
    assert (tour.name, tour.run, tour.operator) == ("series 3: tour", "series 3", "Müller")
    assert (tour.sample, tour.effects, tour.machine) == ("oocyte 7", "zn hysteresis", "abc")
    assert tour.duration_s == pytest.approx(1.99)
    assert f"{tour.began:%H:%M:%S}" == "05:06:07"
    assert (old_playback.name, old_playback.began.year) == ("old", 2025)
    assert old_playback.kind == RecordKind.PLAYBACK
    assert (recording.kind, recording.robot) == (RecordKind.RECORDING, "RoTeMiNa")
    assert recording.duration_s == pytest.approx(1.2, abs=0.01)
    assert recording.gap.axis in ROBOT.axes
    assert recording.events >= 1


def test_unreadable_files_are_reported_and_do_not_hide_others(data_folder):
    write_zn_record(data_folder / "played" / "good.csv")
    (data_folder / "recordings").mkdir()
    (data_folder / "recordings" / "spoilt.arrows").write_bytes(b"nothing of ours")
    (data_folder / "played" / "cut.csv.gz").write_bytes(b"\x1f\x8b\x08")
    problems = {entry.path.name: entry.problem for entry in refresh_catalogue(data_folder).entries}
    assert problems["good.csv"] == ""
    assert "not a recording of this program" in problems["spoilt.arrows"]
    assert "cut.csv.gz" in problems["cut.csv.gz"]


def test_unchanged_files_are_not_opened_again(data_folder, monkeypatch):
    write_zn_record(data_folder / "played" / "good.csv")
    before = refresh_catalogue(data_folder).entries
    monkeypatch.setattr(library, "add_facts", None)
    monkeypatch.setattr(library, "compute_digest", None)
    assert refresh_catalogue(data_folder).entries == before


def test_texts_survive_changed_missing_and_restored_files(data_folder, tour):
    write_zn_record(tour, rows=300)  # another record was written to the same path
    (entry,) = refresh_catalogue(data_folder).entries
    assert (entry.name, entry.note, entry.changed) == ("first try", "keep me", True)
    assert entry.duration_s == pytest.approx(2.99)
    tour.rename(data_folder / "elsewhere.csv")
    (entry,) = refresh_catalogue(data_folder).entries
    assert (entry.missing, entry.is_usable) == (True, False)
    (data_folder / "elsewhere.csv").rename(tour)
    (entry,) = refresh_catalogue(data_folder).entries
    assert (entry.missing, entry.note) == (False, "keep me")


def test_renamed_or_touched_file_keeps_its_entry(data_folder, tour):
    tour.rename(tour.with_name("renamed.csv")).touch()
    (entry,) = refresh_catalogue(data_folder).entries
    assert (entry.path.name, entry.note, entry.changed) == ("renamed.csv", "keep me", False)


@pytest.mark.usefixtures("tour")
def test_data_folder_can_be_moved_or_copied(data_folder, tmp_path):
    # ``copyfile`` gives the copies new dates.
    shutil.copytree(data_folder, tmp_path / "copy", copy_function=shutil.copyfile)
    shutil.rmtree(data_folder)
    (entry,) = refresh_catalogue(tmp_path / "copy").entries
    assert entry.path == tmp_path / "copy" / "played" / "tour.csv"
    assert (entry.note, entry.missing, entry.changed) == ("keep me", False, False)


def test_moved_external_files_are_found_again_together(data_folder, tmp_path):
    catalogue = RecordCatalogue(data_folder)
    for name in ("one.csv", "two.csv"):
        record = write_zn_record(tmp_path / "stick" / name, {"run": name})
        catalogue.add(tmp_path / "stick" / name, record, name)
    (tmp_path / "stick").rename(tmp_path / "moved")
    catalogue.refresh()
    assert [entry.missing for entry in catalogue.entries] == [True, True]
    entry = next(entry for entry in catalogue.entries if entry.path.name == "one.csv")
    with pytest.raises(LibraryError, match="not those of the record"):
        catalogue.set_path(entry.id, tmp_path / "moved" / "two.csv")
    catalogue.set_path(entry.id, tmp_path / "moved" / "one.csv")
    assert not any(entry.missing for entry in catalogue.entries)
    assert refresh_catalogue(data_folder).entries == catalogue.entries


def test_two_programs_add_and_change_entries_without_loss(data_folder):
    first, second = RecordCatalogue(data_folder), RecordCatalogue(data_folder)
    for number, catalogue in enumerate((first, second)):
        path = data_folder / "played" / f"{number}.csv"
        catalogue.add(path, write_zn_record(path, {}), path.name)
    for catalogue in (first, second):
        catalogue.refresh()
    assert first.entries == second.entries
    entry_id = next(entry.id for entry in first.entries if entry.name == "0")
    first.set_texts(entry_id, note="by the first")
    second.set_texts(entry_id, name="by the second")
    first.refresh()
    assert map_names_to_notes(first) == {"by the second": "by the first", "1": ""}


def test_crash_while_listing_loses_no_record(data_folder, monkeypatch):
    write_zn_record(data_folder / "played" / "a.csv")
    write_zn_record(data_folder / "played" / "b.csv")
    monkeypatch.setattr(library, "_FILES_PER_COMMIT", 1)
    added_entries = []

    def interrupt_second_call(entry):
        if added_entries:
            raise KeyboardInterrupt
        added_entries.append(entry)
        return file_facts.add_facts(entry)

    with monkeypatch.context() as patched:
        patched.setattr(library, "add_facts", interrupt_second_call)
        with pytest.raises(KeyboardInterrupt):
            refresh_catalogue(data_folder)
    assert len(RecordStore(data_folder).read_all()) == 1
    assert len(refresh_catalogue(data_folder).entries) == 2


def test_interrupted_write_is_rolled_back(data_folder):
    write_zn_record(data_folder / "played" / "a.csv")
    catalogue = refresh_catalogue(data_folder)
    store = RecordStore(data_folder)

    def yield_interrupted_entries():
        yield replace(catalogue.entries[0], gap=None, events=9)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        store.put(yield_interrupted_entries())
    assert store.read_all()[0].events == 0


def test_damaged_database_is_set_aside_and_rebuilt(data_folder):
    write_zn_record(data_folder / "played" / "a.csv")
    refresh_catalogue(data_folder)
    (data_folder / "records.sqlite3").write_bytes(b"no database at all" * 100)
    catalogue = RecordCatalogue(data_folder)
    with pytest.raises(DamagedLibraryError, match=r"kept as records\.damaged-1\.sqlite3"):
        catalogue.refresh()
    assert [entry.path.name for entry in catalogue.entries] == ["a.csv"]
    assert (data_folder / "records.damaged-1.sqlite3").read_bytes().startswith(b"no database")


def test_library_of_a_newer_program_is_refused_and_unchanged(data_folder):
    data_folder.mkdir()
    with sqlite3.connect(data_folder / "records.sqlite3") as base:
        base.execute("PRAGMA user_version = 7")
    base.close()
    with pytest.raises(LibraryError, match="has version 7, but this program uses 1"):
        refresh_catalogue(data_folder)


def test_gap_is_that_of_the_run_with_its_model(data_folder):
    path = data_folder / "played" / "tour.csv"
    record = write_zn_record(path, offset=2e-6)
    run = compare_with_model(ModelInUse.make_nominal(Simulator(ROBOT)), "tour", record)
    catalogue = RecordCatalogue(data_folder)
    catalogue.add(path, record, "tour.csv")
    catalogue.set_gap(path, run, ROBOT)
    (entry,) = refresh_catalogue(data_folder).entries
    figure = run.gaps["zn", Tap.MEAS]
    assert (entry.gap.axis, entry.gap.rms, entry.gap.unit) == ("zn", figure.rms, "m")
    assert entry.model == run.model_id
    other_run = replace(run, model_id="another")
    # A later comparison with another model changes nothing.
    catalogue.set_gap(path, other_run, ROBOT)
    assert refresh_catalogue(data_folder).entries == (entry,)


def test_delete_removes_own_files_and_keeps_external_ones(data_folder, tmp_path):
    own, other = data_folder / "played" / "own.csv", tmp_path / "other.csv"
    catalogue = RecordCatalogue(data_folder)
    for path in (own, other):
        catalogue.add(path, write_zn_record(path), path.name)
    catalogue.delete({entry.id for entry in catalogue.entries})
    assert catalogue.entries == refresh_catalogue(data_folder).entries == ()
    assert (own.exists(), other.exists()) == (False, True)


def test_records_and_short_recordings_are_read_but_long_ones_refused(
    data_folder, make_recording, monkeypatch
):
    write_zn_record(data_folder / "played" / "tour.csv")
    make_recording(data_folder / "recordings" / "run.arrows")
    for entry in refresh_catalogue(data_folder).entries:
        record = read_entry(entry, ROBOT)
        assert record.duration_s == pytest.approx(entry.duration_s, abs=0.05)
    recording = next(
        entry
        for entry in refresh_catalogue(data_folder).entries
        if entry.kind is RecordKind.RECORDING
    )
    # Only x moves, and it is at rest at both ends.
    assert read_commands(recording, ROBOT, 0.01).axes == ("x",)
    monkeypatch.setattr(library, "MAX_RECORD_ROWS", 10)
    with pytest.raises(LibraryError, match="samples are too many"):
        read_entry(recording, ROBOT)


def test_search_requires_every_word(data_folder):
    write_zn_record(data_folder / "played" / "tour.csv")
    entries = (
        *refresh_catalogue(data_folder).entries,
        LibraryEntry(path=Path("z.csv"), kind=RecordKind.FILE, name="plain", note="dry DISH"),
    )

    def find_names(*arguments):
        return [entry.name for entry in search_entries(entries, *arguments)]

    assert find_names("") == ["series 3: tour", "plain"]
    assert find_names("müller OOCYTE") == ["series 3: tour"]
    assert find_names("müller dish") == []
    assert find_names("dish") == find_names("", {RecordKind.FILE}) == ["plain"]
    assert find_names("2026-03-04 hysteresis") == ["series 3: tour"]


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
def test_duration_is_read_from_first_and_last_row(data_folder, text, duration_s):
    path = data_folder / "played" / "a.csv"
    path.parent.mkdir(parents=True)
    path.write_text(text)
    assert refresh_catalogue(data_folder).entries[0].duration_s == duration_s
