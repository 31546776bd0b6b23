"""Texts of the recorder panel, and parsing of a section."""

from pathlib import Path

import pytest

from rotemina.plugins.recorder.interrupted_files import InterruptedRecording
from rotemina.plugins.recorder.recording_controls import find_space_warning, format_free_space
from rotemina.plugins.recorder.words import (
    SpanError,
    describe_interrupted,
    parse_section,
)


def test_free_space_is_shown_with_the_recording_time_left():
    assert format_free_space(None, 0, 0.0) == "unknown"
    assert format_free_space(5_000_000_000, 1000, 1.0) == "5 GB"  # too early for a rate
    # At 1 MB/s: the 100 MB written so far need another 100 MB when they are joined.
    assert format_free_space(7_300_000_000, 100_000_000, 100.0) == "7.3 GB, for 1.0 h"


def test_low_disk_space_is_reported_early():
    assert find_space_warning(None, 10**9) is None
    assert find_space_warning(2 * 10**9, 10**9) is None
    assert "Free disk space" in find_space_warning(10**9, 10**9)


def test_interrupted_files_and_recordings_of_others_are_named():
    assert describe_interrupted([]) == ""
    text = describe_interrupted(
        [InterruptedRecording(Path(f"{name}.part"), 1000, False) for name in "abcde"]
        + [InterruptedRecording(Path("z.part"), 1, True)]
    )
    assert "a.part (1 kB), b.part (1 kB), c.part (1 kB) and 2 more" in text
    assert "Another program is recording z.part" in text


@pytest.mark.parametrize(
    ("begin", "end", "section"),
    [
        ("", "", (0.0, 10.0)),
        (" 2.5 ", "4", (2.5, 4.0)),
        ("9", "99", (9, 99)),
    ],
)
def test_a_typed_section_is_parsed(begin, end, section):
    assert parse_section(begin, end, 10.0) == section


@pytest.mark.parametrize(
    ("begin", "end", "message"),
    [
        ("1,5", "", "start: '1,5' is not valid"),
        ("-1", "", "start: '-1' is not valid"),
        ("", "nan", "end: 'nan' is not valid"),
        ("", "1e999", "end: '1e999' is not valid"),
        ("5", "5", "must be later"),
        ("10", "20", "lasts 10.000 s"),
    ],
)
def test_an_invalid_section_is_refused(begin, end, message):
    with pytest.raises(SpanError, match=message):
        parse_section(begin, end, 10.0)
