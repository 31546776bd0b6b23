"""The support bundle: names nobody, holds what helps, and is there whole or not at all."""

import getpass
import json
import zipfile
from datetime import datetime
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.motion.state import SessionState
from rotemina.app.shell.anonymiser import Anonymiser
from rotemina.app.shell.message_log import Message
from rotemina.app.shell.progress_line import CancelledError, Progress
from rotemina.app.shell.support_bundle import gather, write_bundle
from rotemina.app.shell.workbench import Level
from rotemina.sim.records.record import Record, Tap
from rotemina.sim.whole_files import FileWriteError

PANELS = ()

ANONYMISER = Anonymiser(
    ["/home/ada.byron", r"C:\Users\Ada Byron"], ["ada.byron", "Ada Byron", "Byron", "x"], ["lab-7"]
)


@pytest.mark.parametrize(
    ("text", "anonymised"),
    [
        ("/home/ada.byron/data/r.csv", "<home>/data/r.csv"),
        (r"C:\Users\Ada Byron\r.csv", r"<home>\r.csv"),
        (r'"C:\\Users\\Ada Byron\\r.csv"', r'"<home>\\r.csv"'),
        ("c:/users/ada byron/r.csv", "<home>/r.csv"),
        ("/home/somebody/r.csv and /Users/other/x", "<home>/r.csv and <home>/x"),
        (r"D:\Users\somebody\r.csv", r"<home>\r.csv"),
        ("owner ADA.BYRON, by Byron", "owner <user>, by <user>"),
        ("/data/ada.byron_old/r.csv", "/data/<user>_old/r.csv"),
        ("on lab-7: x is at 3", "on <host>: x is at 3"),
        ("the byronic robot at home, /homes/a", "the byronic robot at home, /homes/a"),
    ],
)
def test_names_and_homes_are_taken_out_and_nothing_else(text, anonymised):
    assert ANONYMISER.anonymise(text) == anonymised


def test_a_short_name_and_the_root_spoil_nothing():
    assert Anonymiser(["/"], ["x", "y"]).anonymise("x: 1 /data/y") == "x: 1 /data/y"


def test_this_user_is_known():
    anonymiser = Anonymiser.of_this_user()
    path = str(Path.home() / "records" / "r.csv")
    assert str(Path.home()) not in anonymiser.anonymise(f"{path} of {getpass.getuser()}")
    if len(getpass.getuser()) > 2:
        assert anonymiser.anonymise(f"of {getpass.getuser()}") == "of <user>"


@pytest.fixture
def items():
    said = "/home/ada.byron/a.csv: no such file"
    messages = [Message(datetime(2026, 3, 4), Level.ERROR, "window", said)]
    time_s = np.arange(5) / 10.0
    record = Record.from_signals(
        time_s, {("x", Tap.CMD): time_s}, {"x": "m"}, metadata={"operator": "Ada Byron"}
    )
    preferences = {"files.folder": "/home/ada.byron/data", "window.theme": "dark"}
    state = SessionState(fault="ada.byron pulled the plug")
    return gather(messages, preferences, state, "simulator", "rotemina", record, ANONYMISER)


def test_a_bundle_holds_log_settings_versions_and_record_and_names_nobody(items, tmp_path):
    path = tmp_path / "bundle.zip"
    write_bundle(path, items)
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        files = {name: archive.read(name).decode("utf-8") for name in archive.namelist()}
    assert set(files) == {
        "log.txt",
        "settings.json",
        "versions.json",
        "machine.json",
        "window.json",
        "record.csv",
    }
    assert "no such file" in files["log.txt"]
    assert json.loads(files["settings.json"])["files.folder"] == "<home>/data"
    assert "numpy" in json.loads(files["versions.json"])["libraries"]
    assert json.loads(files["machine.json"])["fault"] == "<user> pulled the plug"
    assert "x" in files["record.csv"]
    for text in files.values():
        assert "byron" not in text.casefold()
        assert "/home/" not in text
    assert {item.name: item.text for item in items} == files  # what was shown before


def test_a_bundle_is_written_whole_or_not_at_all(items, tmp_path):
    path = tmp_path / "bundle.zip"
    progress = Progress("Written.")

    def reached(share):
        if share > 0.3:
            progress.cancel()
        progress.reached(share)

    with pytest.raises(CancelledError):
        write_bundle(path, items, reached)
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(FileWriteError, match="folder"):
        write_bundle(tmp_path, items)
    path.write_bytes(b"before")
    with pytest.raises(CancelledError):
        write_bundle(path, items, reached)
    assert path.read_bytes() == b"before"


def test_without_a_record_there_is_none_in_it():
    items = gather([], {}, SessionState(), "simulator", "rotemina", None, ANONYMISER)
    assert "record.csv" not in {item.name for item in items}
