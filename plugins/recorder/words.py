"""The words and numbers of the recorder panel."""

from collections.abc import Sequence

from rotemina.app.display import PLAIN_NUMBER, duration_text, size_text
from rotemina.app.shell.language import marked, translate
from rotemina.plugins.recorder.listing import Listed, Unfinished
from rotemina.sim.errors import InputError

BEGIN, END = marked("recorder", "begin"), marked("recorder", "end")
COLUMNS = (
    marked("recorder", "Recorded"),
    marked("recorder", "Length"),
    marked("recorder", "Size"),
    marked("recorder", "Events"),
    marked("recorder", "Robot"),
    marked("recorder", "File"),
)
# Ending a recording takes as much room again as it has used.
_SPARE_BYTES = 500_000_000
_STEADY_S = 5.0  # of a recording, from which on its rate says something


class SpanError(InputError):
    """A stretch of a recording that is none."""


def cells(one: Listed) -> tuple[str, ...]:
    """Return one text for each of :data:`COLUMNS`."""
    if one.problem:
        return (
            translate("recorder", "cannot be opened"),
            "–",
            size_text(one.size),
            "–",
            "–",
            one.path.name,
        )
    began = "–" if one.began is None else f"{one.began:%Y-%m-%d %H:%M:%S}"
    length = duration_text(one.duration_s, 1)
    return began, length, size_text(one.size), str(one.events), one.robot, one.path.name


def room_text(free: int | None, written: int, since_s: float) -> str:
    """Return how much room is left, and for how long it lasts."""
    if free is None:
        return translate("recorder", "unknown")
    if since_s < _STEADY_S or written <= 0:
        return size_text(free)
    lasts_s = max(free - written, 0) / (2.0 * written / since_s)
    hours = lasts_s / 3600.0
    left = (
        translate("recorder", "{n:.0f} days").format(n=hours / 24.0)
        if hours > 72.0
        else translate("recorder", "{hours:.1f} h").format(hours=hours)
    )
    return translate("recorder", "{size}, for {left}").format(size=size_text(free), left=left)


def scarce(free: int | None, written: int) -> str | None:
    """Return what is to be done about too little room; None where there is enough."""
    if free is None or free > written + _SPARE_BYTES:
        return None
    return translate(
        "recorder",
        "Only {free} are free, and ending the recording takes "
        "{size}: make room. Motion goes on in any case.",
    ).format(free=size_text(free), size=size_text(written))


def unfinished_text(unfinished: Sequence[Unfinished]) -> str:
    """Return what a crash has left, and what other programs record; "" for nothing."""
    lines = []
    waiting = [f"{one.path.name} ({size_text(one.size)})" for one in unfinished if not one.busy]
    if waiting:
        lines.append(
            translate(
                "recorder", "Not ended, as the program or its computer was cut off: {names}."
            ).format(names=listed(waiting))
        )
    lines += [
        translate("recorder", "{name} is being recorded by another program.").format(
            name=one.path.name
        )
        for one in unfinished
        if one.busy
    ]
    return "\n".join(lines)


def listed(names: Sequence[str]) -> str:
    """Return names one behind the other; of many, the first."""
    most = 3
    more = (
        translate("recorder", " and {n} more").format(n=len(names) - most)
        if len(names) > most
        else ""
    )
    return ", ".join(names[:most]) + more


def span(begin: str, end: str, duration_s: float) -> tuple[float, float]:
    """Return the stretch that somebody typed, s from the begin; nothing means begin or end.

    Raises
    ------
    SpanError
        If it is none.
    """
    begin_s = _seconds(begin, 0.0, BEGIN)
    end_s = _seconds(end, duration_s, END)
    if not begin_s < end_s:
        raise SpanError(
            translate(
                "recorder",
                "from {begin:g} s to {end:g} s: the end must be later than the begin",
            ).format(begin=begin_s, end=end_s)
        )
    if begin_s >= duration_s:
        raise SpanError(
            translate("recorder", "from {begin:g} s: the recording lasts {duration:.3f} s").format(
                begin=begin_s, duration=duration_s
            )
        )
    return begin_s, end_s


def _seconds(text: str, otherwise: float, what: str) -> float:
    text = text.strip()
    if not text:
        return otherwise
    if PLAIN_NUMBER.fullmatch(text) is None or not 0.0 <= float(text) < float("inf"):
        raise SpanError(
            translate(
                "recorder",
                "{text!r} is no {what}: type seconds from the begin of the recording, "
                "0 or more, with a decimal point, or nothing",
            ).format(text=text, what=translate("recorder", what))
        )
    return float(text)
