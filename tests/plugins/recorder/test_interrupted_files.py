"""Interrupted recordings that a crash has left in the folder."""

import pytest

from rotemina.app.workbench import measure_free_bytes
from rotemina.plugins.recorder.interrupted_files import find_interrupted, recover_all

NO_FILES = frozenset()


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "recordings"


def test_interrupted_files_are_distinguished_from_running_recordings(folder, make_recording):
    busy = make_recording(folder / "busy.arrows", ended=False).with_name("busy.arrows.part")
    own = make_recording(folder / "own.arrows", ended=False).with_name("own.arrows.part")
    crashed = folder / "crashed.arrows.part"
    crashed.write_bytes(busy.read_bytes())
    interrupted = find_interrupted(folder, frozenset({own}))
    assert [(file.path, file.busy) for file in interrupted] == [(busy, True), (crashed, False)]
    invalid_file = folder / "spoilt.arrows.part"
    invalid_file.write_bytes(b"nothing of ours")
    recovered, refused = recover_all((invalid_file, crashed))
    assert recovered == (folder / "crashed.arrows",)
    assert len(refused) == 1
    assert "spoilt.arrows.part: not an interrupted recording" in refused[0]
    assert [file.path for file in find_interrupted(folder, NO_FILES)] == [busy, own, invalid_file]


def test_a_missing_folder_is_empty_and_has_free_space(folder):
    assert find_interrupted(folder, NO_FILES) == ()
    assert measure_free_bytes(folder / "deeper") > 0
