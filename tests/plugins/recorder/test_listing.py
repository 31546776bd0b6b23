"""What is found in the folder of recordings."""

import pytest

from rotemina.plugins.recorder.listing import Found, free_bytes, look, recovered

NONE = frozenset()


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "recordings"


def test_finished_ones_are_listed_newest_first_and_spoilt_ones_say_why(folder, make_recording):
    made = make_recording(folder / "made.arrows")
    (folder / "spoilt.arrows").write_bytes(b"nothing of ours")
    found = look(folder, NONE, {})
    spoilt, good = found.recordings  # without a date, that of the file counts
    assert (good.path, good.robot, good.problem) == (made, "RoTeMiNa", "")
    assert good.began.isoformat() == "2026-03-04T05:06:07+01:00"
    assert good.duration_s == pytest.approx(1.2, abs=0.01)
    assert good.events >= 1
    assert good.size == made.stat().st_size
    assert "spoilt.arrows: no recording of this program" in spoilt.problem
    assert found.unfinished == ()


def test_what_has_not_changed_is_not_opened_again(folder, make_recording, monkeypatch):
    made = make_recording(folder / "made.arrows")
    (one,) = look(folder, NONE, {}).recordings
    monkeypatch.setattr("rotemina.plugins.recorder.listing.Recording", None)
    assert look(folder, NONE, {made: one}).recordings == (one,)


def test_left_ones_are_told_from_those_that_are_recorded_now(folder, make_recording):
    busy = make_recording(folder / "busy.arrows", ended=False).with_name("busy.arrows.part")
    own = make_recording(folder / "own.arrows", ended=False).with_name("own.arrows.part")
    crashed = folder / "crashed.arrows.part"
    crashed.write_bytes(busy.read_bytes())
    found = look(folder, frozenset({own}), {})
    assert [(one.path, one.busy) for one in found.unfinished] == [(busy, True), (crashed, False)]
    spoilt = folder / "spoilt.arrows.part"
    spoilt.write_bytes(b"nothing of ours")
    done, refused = recovered((spoilt, crashed))
    assert done == (folder / "crashed.arrows",)
    assert len(refused) == 1
    assert "spoilt.arrows.part: no recording" in refused[0]
    assert [one.path for one in look(folder, NONE, {}).recordings] == list(done)


def test_a_folder_that_is_not_there_yet_is_empty_and_has_room(folder):
    assert look(folder, NONE, {}) == Found()
    assert free_bytes(folder / "deeper") > 0
