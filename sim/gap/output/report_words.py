"""Texts of the report: names and verdicts in the language of the report."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar

from rotemina.sim.effects import load_effect
from rotemina.sim.errors import EffectError
from rotemina.sim.gap.location import OperatingRegime
from rotemina.sim.gap.result import (
    UNKNOWN_EFFECT_ID,
    FittedParameter,
    GapCause,
    GapVerdict,
)
from rotemina.sim.messages import (
    Message,
    MessageWording,
    marked,
)
from rotemina.sim.records import Record, Tap

UNKNOWN_EFFECT_TITLE = marked("gap", "Unknown effect")
ROBOT_VERDICTS = {
    GapVerdict.NONE: marked("gap", "No gap: model and machine differ by no more than noise"),
    GapVerdict.EXPLAINED: marked("gap", "Explained: the effects below account for the gap"),
    GapVerdict.PARTLY: marked("gap", "Partly explained: the cause of the rest is unknown"),
    GapVerdict.UNKNOWN: marked("gap", "Unknown: no effect of the catalogue explains the gap"),
    GapVerdict.INSUFFICIENT: marked("gap", "Undecided: the records lack excitation"),
    GapVerdict.FAILED: marked("gap", "Not examined, because the program failed"),
}
AXIS_VERDICTS = {
    **ROBOT_VERDICTS,
    GapVerdict.NONE: marked("gap", "No gap of its own"),
    GapVerdict.EXPLAINED: marked("gap", "Explained"),
    GapVerdict.PARTLY: marked("gap", "Partly explained"),
}
REGIMES = {
    OperatingRegime.REST: marked("gap", "rest"),
    OperatingRegime.SETTLING: marked("gap", "settling"),
    OperatingRegime.REVERSAL: marked("gap", "reversal"),
    OperatingRegime.FORWARD: marked("gap", "forward"),
    OperatingRegime.BACKWARD: marked("gap", "backward"),
    OperatingRegime.FAST: marked("gap", "fast"),
    OperatingRegime.SLOW: marked("gap", "slow"),
    OperatingRegime.OTHER_AXIS: marked("gap", "other axis moving"),
    OperatingRegime.LARGE_SWING: marked("gap", "large swing"),
    OperatingRegime.SMALL_SWING: marked("gap", "small swing"),
    OperatingRegime.LOW_END: marked("gap", "low end of travel"),
    OperatingRegime.MIDDLE: marked("gap", "middle of travel"),
    OperatingRegime.HIGH_END: marked("gap", "high end of travel"),
    OperatingRegime.FIRST_QUARTER: marked("gap", "first quarter of a turn"),
    OperatingRegime.SECOND_QUARTER: marked("gap", "second quarter of a turn"),
    OperatingRegime.THIRD_QUARTER: marked("gap", "third quarter of a turn"),
    OperatingRegime.LAST_QUARTER: marked("gap", "last quarter of a turn"),
}
# The wording of the current report. It is a context variable, so that the drawings can use it too.
_ENGLISH = MessageWording()
_wording: ContextVar[MessageWording] = ContextVar("wording", default=_ENGLISH)


@contextmanager
def use_wording(wording: MessageWording) -> Iterator[None]:
    """Use a wording for the report while the context is active."""
    token = _wording.set(wording)
    try:
        yield
    finally:
        _wording.reset(token)


def localize_text(template: str, **fields: str | float) -> str:
    """Return a text in the language of the report, with its fields filled in."""
    return localize(Message("gap", template, tuple(fields.items())))


def localize(text: str) -> str:
    """Return a message or a number in the language of the report."""
    return _wording.get().format_field(text)


def localize_effect_title(effect_id: str) -> str:
    """Return the title of an effect in the language of the report, or its id if not installed."""
    return (
        localize_text(UNKNOWN_EFFECT_TITLE)
        if effect_id == UNKNOWN_EFFECT_ID
        else localize_name(find_english_title(effect_id))
    )


def localize_name(name: str) -> str:
    """Return the name of an effect, a formulation or a stage in the language of the report."""
    return _wording.get().localize_text("effects", name.replace("_", " "))


def find_english_title(effect_id: str) -> str:
    """Return the English title of an effect, or its id if it is not installed."""
    if effect_id == UNKNOWN_EFFECT_ID:
        return UNKNOWN_EFFECT_TITLE
    try:
        return load_effect(effect_id).title
    except EffectError:
        return effect_id


def find_parameter_unit(
    parameter: FittedParameter, cause: GapCause, records: Sequence[Record]
) -> str:
    """Return the unit of a parameter, which may contain the unit of the source axis."""
    source = cause.from_axis
    source_unit = unit_of(source, Tap.MEAS, records) if source is not None else ""
    return complete_unit(parameter.unit, source_unit)


def unit_of(axis: str, tap: Tap, records: Sequence[Record]) -> str:
    """Return the SI unit of a tap of an axis, or an empty text if no record has the axis."""
    if tap is Tap.U:
        return "V"
    return next((record.units[axis] for record in records if axis in record.axes), "")


def complete_unit(unit: str, source_unit: str) -> str:
    """Return the unit of a parameter, completed with the unit of the source axis of the effect.

    In ``unit``, the sign ``…`` stands for the unit of that axis.
    """
    return "" if unit == f"{source_unit}/…" else unit.replace("…", source_unit or "…")
