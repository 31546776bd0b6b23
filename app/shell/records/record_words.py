"""A record of the library as text: the cells of its table row, and its tooltip."""

from collections.abc import Iterator
from datetime import datetime

from rotemina.app.language import (
    format_duration,
    format_file_size,
    get_axis_label,
    marked,
    translate,
)
from rotemina.app.records import (
    LibraryEntry,
    RecordKind,
    WorstGap,
)
from rotemina.sim.comparison import format_gap
from rotemina.sim.messages import NO_VALUE

NAME_COLUMN, BEGAN_COLUMN, LENGTH_COLUMN, GAP_COLUMN, NOTE_COLUMN = range(5)
COLUMN_TITLES = (
    marked("shell", "Name"),
    marked("shell", "Recorded"),
    marked("shell", "Length"),
    marked("shell", "Gap"),
    marked("shell", "Note"),
    marked("shell", "Sample"),
    marked("shell", "Operator"),
    marked("shell", "Effects"),
    marked("shell", "Model"),
    marked("shell", "Machine"),
    marked("shell", "Size"),
    marked("shell", "Kind"),
    marked("shell", "File"),
)
KIND_NAMES = {
    RecordKind.PLAYBACK: (marked("shell", "playback"), marked("shell", "Playbacks")),
    RecordKind.RECORDING: (marked("shell", "recording"), marked("shell", "Recordings")),
    RecordKind.FILE: (marked("shell", "file"), marked("shell", "Other files")),
}


def make_cells(entry: LibraryEntry) -> tuple[str, ...]:
    """Return one text for each of :data:`COLUMN_TITLES`."""
    machine = ", ".join(filter(None, (entry.robot, entry.driver)))
    return (
        entry.name,
        format_moment(entry.began) or NO_VALUE,
        NO_VALUE if entry.duration_s is None else format_duration(entry.duration_s, 1),
        format_worst_gap(entry.gap),
        entry.note,
        entry.sample,
        entry.operator,
        entry.effects,
        entry.model,
        machine,
        format_file_size(entry.size),
        translate("shell", KIND_NAMES[entry.kind][0]),
        entry.path.name,
    )


def format_worst_gap(gap: WorstGap | None) -> str:
    """Return the name and gap of the axis with the largest gap."""
    return (
        NO_VALUE if gap is None else f"{get_axis_label(gap.axis)} {format_gap(gap.rms, gap.unit)}"
    )


def format_moment(began: datetime | None) -> str:
    """Return when a record was taken, in local time; "" if unknown."""
    return "" if began is None else f"{began.astimezone():%Y-%m-%d %H:%M:%S}"


def describe_file_problem(entry: LibraryEntry) -> str:
    """Return the problem with a record's file, or ""."""
    if entry.missing:
        return translate("shell", "The file is missing: delete the entry, or find the file")
    if entry.problem:
        return translate("shell", "cannot be opened: {problem}").format(problem=entry.problem)
    if entry.changed:
        return translate("shell", "The file has changed since it was listed")
    return ""


def make_tooltip_lines(entry: LibraryEntry) -> Iterator[str]:
    """Yield all known properties of a record, one line each."""
    yield describe_file_problem(entry)
    for name, text in zip(COLUMN_TITLES, make_cells(entry), strict=True):
        if text and text != NO_VALUE:
            yield f"{translate('shell', name)}: {text}"
    if entry.run:
        yield translate("shell", "Run: {run}").format(run=entry.run)
    if entry.events:
        yield translate("shell", "Events: {n}").format(n=entry.events)
    yield str(entry.path)
