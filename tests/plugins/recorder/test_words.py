"""The words of the recorder panel."""

from pathlib import Path

import pytest

from rotemina.plugins.recorder.interrupted_files import Unfinished
from rotemina.plugins.recorder.recording_controls import room_text, scarce
from rotemina.plugins.recorder.words import (
    SpanError,
    span,
    unfinished_text,
)


def test_room_lasts_half_as_long_as_what_is_put_together_takes_twice():
    assert room_text(None, 0, 0.0) == "unknown"
    assert room_text(5_000_000_000, 1000, 1.0) == "5 GB"  # too early for a rate
    # 1 MB/s: 100 MB are written, which take 100 MB more when they are put together.
    assert room_text(7_300_000_000, 100_000_000, 100.0) == "7.3 GB, for 1.0 h"


def test_scarce_room_is_said_in_time():
    assert scarce(None, 10**9) is None
    assert scarce(2 * 10**9, 10**9) is None
    assert "Free disk space" in scarce(10**9, 10**9)


def test_what_was_left_is_named_and_what_others_record_is_said_so():
    assert unfinished_text([]) == ""
    text = unfinished_text(
        [Unfinished(Path(f"{n}.part"), 1000, False) for n in "abcde"]
        + [Unfinished(Path("z.part"), 1, True)]
    )
    assert "a.part (1 kB), b.part (1 kB), c.part (1 kB) and 2 more" in text
    assert "Another program is recording z.part" in text


@pytest.mark.parametrize(
    ("begin", "end", "stretch"),
    [
        ("", "", (0.0, 10.0)),
        (" 2.5 ", "", (2.5, 10.0)),
        ("", "4", (0.0, 4.0)),
        ("9", "99", (9, 99)),
    ],
)
def test_a_stretch_as_typed(begin, end, stretch):
    assert span(begin, end, 10.0) == stretch


@pytest.mark.parametrize(
    ("begin", "end", "why"),
    [
        ("1,5", "", "start: '1,5' is not valid"),
        ("-1", "", "start: '-1' is not valid"),
        ("", "nan", "end: 'nan' is not valid"),
        ("", "1e999", "end: '1e999' is not valid"),
        ("5", "5", "must be later"),
        ("10", "20", "lasts 10.000 s"),
    ],
)
def test_what_is_no_stretch_is_refused(begin, end, why):
    with pytest.raises(SpanError, match=why):
        span(begin, end, 10.0)
