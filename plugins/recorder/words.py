"""The words and numbers of the recorder panel. Free of Qt."""

from collections.abc import Sequence

from rotemina.app.display import PLAIN_NUMBER, duration_text, size_text
from rotemina.plugins.recorder.listing import Left, Listed
from rotemina.sim.errors import InputError

COLUMNS = ("Recorded", "Length", "Size", "Events", "Robot", "File")
# Ending a recording takes as much room again as it has used.
_SPARE_BYTES = 500_000_000
_STEADY_S = 5.0  # of a recording, from which on its rate says something


class SpanError(InputError):
    """A stretch of a recording that is none."""


def cells(one: Listed) -> tuple[str, ...]:
    """Return one text for each of :data:`COLUMNS`."""
    if one.problem:
        return "cannot be opened", "–", size_text(one.size), "–", "–", one.path.name
    began = "–" if one.began is None else f"{one.began:%Y-%m-%d %H:%M:%S}"
    length = duration_text(one.duration_s, 1)
    return began, length, size_text(one.size), str(one.events), one.robot, one.path.name


def room_text(free: int | None, written: int, since_s: float) -> str:
    """Return how much room is left, and for how long it lasts."""
    if free is None:
        return "unknown"
    if since_s < _STEADY_S or written <= 0:
        return size_text(free)
    lasts_s = max(free - written, 0) / (2.0 * written / since_s)
    hours = lasts_s / 3600.0
    left = f"{hours / 24.0:.0f} days" if hours > 72.0 else f"{hours:.1f} h"
    return f"{size_text(free)}, for {left}"


def scarce(free: int | None, written: int) -> str | None:
    """Return what is to be done about too little room; None where there is enough."""
    if free is None or free > written + _SPARE_BYTES:
        return None
    return (
        f"Only {size_text(free)} are free, and ending the recording takes {size_text(written)}: "
        "make room. Motion goes on in any case."
    )


def left_text(left: Sequence[Left]) -> str:
    """Return what a crash has left, and what other programs record; "" for nothing."""
    lines = []
    waiting = [f"{one.path.name} ({size_text(one.size)})" for one in left if not one.busy]
    if waiting:
        lines.append(f"Not ended, as the program or its computer was cut off: {listed(waiting)}.")
    lines += [f"{one.path.name} is being recorded by another program." for one in left if one.busy]
    return "\n".join(lines)


def listed(names: Sequence[str]) -> str:
    """Return names one behind the other; of many, the first."""
    most = 3
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def span(begin: str, end: str, duration_s: float) -> tuple[float, float]:
    """Return the stretch that somebody typed, s from the begin; nothing means begin or end.

    Raises
    ------
    SpanError
        If it is none.
    """
    begin_s = _seconds(begin, 0.0, "begin")
    end_s = _seconds(end, duration_s, "end")
    if not begin_s < end_s:
        raise SpanError(f"from {begin_s:g} s to {end_s:g} s: the end must be later than the begin")
    if begin_s >= duration_s:
        raise SpanError(f"from {begin_s:g} s: the recording lasts {duration_s:.3f} s")
    return begin_s, end_s


def _seconds(text: str, otherwise: float, what: str) -> float:
    text = text.strip()
    if not text:
        return otherwise
    if PLAIN_NUMBER.fullmatch(text) is None or not 0.0 <= float(text) < float("inf"):
        raise SpanError(
            f"{text!r} is no {what}: type seconds from the begin of the recording, 0 or more, "
            "with a decimal point, or nothing"
        )
    return float(text)
