"""What a crash has left in the folder of recordings."""

import pytest

from rotemina.app.shell.record_library import free_bytes
from rotemina.plugins.recorder.interrupted_files import look, recovered

NONE = frozenset()


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "recordings"


def test_left_ones_are_told_from_those_that_are_recorded_now(folder, make_recording):
    busy = make_recording(folder / "busy.arrows", ended=False).with_name("busy.arrows.part")
    own = make_recording(folder / "own.arrows", ended=False).with_name("own.arrows.part")
    crashed = folder / "crashed.arrows.part"
    crashed.write_bytes(busy.read_bytes())
    found = look(folder, frozenset({own}))
    assert [(one.path, one.busy) for one in found] == [(busy, True), (crashed, False)]
    spoilt = folder / "spoilt.arrows.part"
    spoilt.write_bytes(b"nothing of ours")
    done, refused = recovered((spoilt, crashed))
    assert done == (folder / "crashed.arrows",)
    assert len(refused) == 1
    assert "spoilt.arrows.part: not an interrupted recording" in refused[0]
    assert [one.path for one in look(folder, NONE)] == [busy, own, spoilt]


def test_a_folder_that_is_not_there_yet_is_empty_and_has_room(folder):
    assert look(folder, NONE) == ()
    assert free_bytes(folder / "deeper") > 0
