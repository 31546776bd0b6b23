"""The support bundle is anonymous, complete, and written whole or not at all."""

import getpass
import json
import zipfile
from datetime import datetime
from pathlib import Path

import numpy as np
import pytest

from rotemina.app.errors import WorkCancelledError
from rotemina.app.motion.state import SessionState
from rotemina.app.shell.support.anonymiser import TextAnonymiser
from rotemina.app.shell.support.message_log import LogMessage
from rotemina.app.shell.support.support_bundle import gather_files, write_bundle
from rotemina.app.workbench import Level, WorkProgress
from rotemina.sim.errors import FileWriteError
from rotemina.sim.records import Record, Tap

PANELS = ()

ANONYMISER = TextAnonymiser(
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
def test_only_names_and_home_folders_are_removed(text, anonymised):
    assert ANONYMISER.anonymise(text) == anonymised


def test_a_short_name_and_the_root_folder_are_kept():
    assert TextAnonymiser(["/"], ["x", "y"]).anonymise("x: 1 /data/y") == "x: 1 /data/y"


def test_the_current_user_is_anonymised():
    anonymiser = TextAnonymiser.for_current_user()
    path = str(Path.home() / "records" / "r.csv")
    assert str(Path.home()) not in anonymiser.anonymise(f"{path} of {getpass.getuser()}")
    if len(getpass.getuser()) > 2:
        assert anonymiser.anonymise(f"of {getpass.getuser()}") == "of <user>"


@pytest.fixture
def items():
    message = "/home/ada.byron/a.csv: no such file"
    messages = [LogMessage(datetime(2026, 3, 4), Level.ERROR, "window", message)]
    time_s = np.arange(5) / 10.0
    record = Record.from_signals(
        time_s, {("x", Tap.CMD): time_s}, {"x": "m"}, metadata={"operator": "Ada Byron"}
    )
    preferences = {"files.folder": "/home/ada.byron/data", "window.theme": "dark"}
    state = SessionState(fault="ada.byron pulled the plug")
    return gather_files(messages, preferences, state, "simulator", "rotemina", record, ANONYMISER)


def test_a_bundle_holds_log_settings_versions_and_record_anonymously(items, tmp_path):
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
    assert {item.name: item.text for item in items} == files  # the contents shown before writing


def test_a_bundle_is_written_whole_or_not_at_all(items, tmp_path):
    path = tmp_path / "bundle.zip"
    progress = WorkProgress("Written.")

    def cancel_early(share):
        if share > 0.3:
            progress.cancel()
        progress.report(share)

    with pytest.raises(WorkCancelledError):
        write_bundle(path, items, cancel_early)
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(FileWriteError, match="folder"):
        write_bundle(tmp_path, items)
    path.write_bytes(b"before")
    with pytest.raises(WorkCancelledError):
        write_bundle(path, items, cancel_early)
    assert path.read_bytes() == b"before"


def test_a_bundle_without_a_record():
    items = gather_files([], {}, SessionState(), "simulator", "rotemina", None, ANONYMISER)
    assert "record.csv" not in {item.name for item in items}
