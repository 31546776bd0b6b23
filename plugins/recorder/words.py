"""Text of the recorder panel, and parsing of a typed time span."""

from collections.abc import Sequence

from rotemina.app.display_units import size_text
from rotemina.plugins.recorder import mark, tr
from rotemina.plugins.recorder.interrupted_files import Unfinished
from rotemina.sim.errors import InputError
from rotemina.sim.quantities import parsed

BEGIN, END = mark("start"), mark("end")


class SpanError(InputError):
    """An invalid time span of a recording."""


def unfinished_text(unfinished: Sequence[Unfinished]) -> str:
    """Return what a crash has left, and what other programs record; "" for nothing."""
    lines = []
    waiting = [f"{one.path.name} ({size_text(one.size)})" for one in unfinished if not one.busy]
    if waiting:
        lines.append(
            tr("Interrupted because the program or the computer stopped: {names}.").format(
                names=listed(waiting)
            )
        )
    lines += [
        tr("Another program is recording {name}.").format(name=one.path.name)
        for one in unfinished
        if one.busy
    ]
    return "\n".join(lines)


def listed(names: Sequence[str]) -> str:
    """Return names one behind the other; of many, the first."""
    most = 3
    more = tr(" and {n} more").format(n=len(names) - most) if len(names) > most else ""
    return ", ".join(names[:most]) + more


def span(begin: str, end: str, duration_s: float) -> tuple[float, float]:
    """Return the stretch that someone typed, s from the begin; nothing means begin or end.

    Raises
    ------
    SpanError
        If it is none.
    """
    begin_s = _seconds(begin, 0.0, BEGIN)
    end_s = _seconds(end, duration_s, END)
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


def _seconds(text: str, otherwise: float, what: str) -> float:
    text = text.strip()
    if not text:
        return otherwise
    number = parsed(text)
    if number is None or not 0.0 <= number < float("inf"):
        raise SpanError(
            tr(
                "{what}: {text!r} is not valid. Enter seconds from the start of the "
                "recording, 0 or more, with a decimal point, or leave the field empty."
            ).format(text=text, what=tr(what))
        )
    return number
