"""Texts of the recorder panel, and parsing of a typed section."""

from collections.abc import Sequence

from rotemina.app.language import format_file_size
from rotemina.plugins.recorder import mark, tr
from rotemina.plugins.recorder.interrupted_files import InterruptedRecording
from rotemina.sim.errors import InputError
from rotemina.sim.messages import parse_number

SECTION_START, SECTION_END = mark("start"), mark("end")


class SpanError(InputError):
    """Invalid section of a recording."""


def describe_interrupted(recordings: Sequence[InterruptedRecording]) -> str:
    """Return a text about interrupted recordings, and about those that other programs make."""
    lines = []
    interrupted = [
        f"{recording.path.name} ({format_file_size(recording.size)})"
        for recording in recordings
        if not recording.busy
    ]
    if interrupted:
        lines.append(
            tr("Interrupted because the program or the computer stopped: {names}.").format(
                names=join_names(interrupted)
            )
        )
    lines += [
        tr("Another program is recording {name}.").format(name=recording.path.name)
        for recording in recordings
        if recording.busy
    ]
    return "\n".join(lines)


def join_names(names: Sequence[str]) -> str:
    """Return up to three names as a list, and how many more there are."""
    max_count = 3
    more_text = (
        tr(" and {n} more").format(n=len(names) - max_count) if len(names) > max_count else ""
    )
    return ", ".join(names[:max_count]) + more_text


def parse_section(begin: str, end: str, duration_s: float) -> tuple[float, float]:
    """Return the typed section as start and end, s from the start of the recording.

    An empty text means the start or the end of the recording.

    Raises
    ------
    SpanError
        If a text is not a valid time, or the section is empty or outside the recording.
    """
    begin_s = _parse_seconds(begin, 0.0, SECTION_START)
    end_s = _parse_seconds(end, duration_s, SECTION_END)
    if not begin_s < end_s:
        raise SpanError(
            tr("from {begin:g} s to {end:g} s: the end must be later than the start").format(
                begin=begin_s, end=end_s
            )
        )
    if begin_s >= duration_s:
        raise SpanError(
            tr("from {begin:g} s: the recording lasts {duration:.3f} s").format(
                begin=begin_s, duration=duration_s
            )
        )
    return begin_s, end_s


def _parse_seconds(text: str, default_s: float, field_name: str) -> float:
    text = text.strip()
    if not text:
        return default_s
    number = parse_number(text)
    if number is None or not 0.0 <= number < float("inf"):
        raise SpanError(
            tr(
                "{what}: {text!r} is not valid. Enter seconds from the start of the "
                "recording, 0 or more, with a decimal point, or leave the field empty."
            ).format(text=text, what=tr(field_name))
        )
    return number
