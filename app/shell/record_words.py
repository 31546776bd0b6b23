"""A record of the library in words: its cells in a table, its tip, its short name."""

from collections.abc import Iterator
from datetime import datetime

from rotemina.app.display_units import duration_text, label, size_text
from rotemina.app.records.entry import Entry, Kind, WorstGap
from rotemina.app.shell.language import marked, translate
from rotemina.sim.comparison.gap import gap_text
from rotemina.sim.quantities import NOTHING

NAME, BEGAN, LENGTH, GAP, NOTE = range(5)
COLUMNS = (
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
KINDS = {
    Kind.PLAYBACK: (marked("shell", "playback"), marked("shell", "Playbacks")),
    Kind.RECORDING: (marked("shell", "recording"), marked("shell", "Recordings")),
    Kind.FILE: (marked("shell", "file"), marked("shell", "Other files")),
}


def cells(one: Entry) -> tuple[str, ...]:
    """Return one text for each of :data:`COLUMNS`."""
    machine = ", ".join(filter(None, (one.robot, one.driver)))
    return (
        one.name,
        moment_text(one.began) or NOTHING,
        NOTHING if one.duration_s is None else duration_text(one.duration_s, 1),
        worst_text(one.gap),
        one.note,
        one.sample,
        one.operator,
        one.effects,
        one.model,
        machine,
        size_text(one.size),
        translate("shell", KINDS[one.kind][0]),
        one.path.name,
    )


def worst_text(gap: WorstGap | None) -> str:
    """Return the gap of the axis that departs most, with the axis."""
    return NOTHING if gap is None else f"{label(gap.axis)} {gap_text(gap.rms, gap.unit)}"


def moment_text(began: datetime | None) -> str:
    """Return when a record was taken, in the time of this place; "" where nobody knows."""
    return "" if began is None else f"{began.astimezone():%Y-%m-%d %H:%M:%S}"


def state_text(one: Entry) -> str:
    """Return what is wrong with a record's file; "" for nothing."""
    if one.missing:
        return translate("shell", "The file is missing: delete the entry, or find the file")
    if one.problem:
        return translate("shell", "cannot be opened: {problem}").format(problem=one.problem)
    if one.changed:
        return translate("shell", "The file has changed since it was listed")
    return ""


def tip_lines(one: Entry) -> Iterator[str]:
    """Yield all that is known of a record, a line each."""
    yield state_text(one)
    for name, text in zip(COLUMNS, cells(one), strict=True):
        if text and text != NOTHING:
            yield f"{translate('shell', name)}: {text}"
    if one.run:
        yield translate("shell", "Run: {run}").format(run=one.run)
    if one.events:
        yield translate("shell", "Events: {n}").format(n=one.events)
    yield str(one.path)
