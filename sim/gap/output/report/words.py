"""Texts of the report: names and verdicts, in the language that it is written in."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.registry import effect_named
from rotemina.sim.gap.diagnosis import UNKNOWN, Cause, FittedParameter, Verdict
from rotemina.sim.gap.location.regimes import Regime
from rotemina.sim.gap.output.report.quantities import named_unit, unit_of
from rotemina.sim.messages import Message, Wording, marked
from rotemina.sim.records.record import Record, Tap

UNKNOWN_EFFECT = marked("gap", "Unknown effect")
VERDICTS = {
    Verdict.NONE: marked("gap", "No gap: model and machine differ by no more than noise"),
    Verdict.EXPLAINED: marked("gap", "Explained: the effects below account for the gap"),
    Verdict.PARTLY: marked("gap", "Partly explained: the cause of the rest is unknown"),
    Verdict.UNKNOWN: marked("gap", "Unknown: no effect of the catalogue explains the gap"),
    Verdict.INSUFFICIENT: marked("gap", "Undecided: the records lack excitation"),
}
AXIS_VERDICTS = {
    **VERDICTS,
    Verdict.NONE: marked("gap", "No gap of its own"),
    Verdict.EXPLAINED: marked("gap", "Explained"),
    Verdict.PARTLY: marked("gap", "Partly explained"),
}
REGIMES = {
    Regime.REST: marked("gap", "rest"),
    Regime.SETTLING: marked("gap", "settling"),
    Regime.REVERSAL: marked("gap", "reversal"),
    Regime.FORWARD: marked("gap", "forward"),
    Regime.BACKWARD: marked("gap", "backward"),
    Regime.FAST: marked("gap", "fast"),
    Regime.SLOW: marked("gap", "slow"),
    Regime.OTHER_AXIS: marked("gap", "other axis moving"),
    Regime.LARGE_SWING: marked("gap", "large swing"),
    Regime.SMALL_SWING: marked("gap", "small swing"),
    Regime.LOW_END: marked("gap", "low end of travel"),
    Regime.MIDDLE: marked("gap", "middle of travel"),
    Regime.HIGH_END: marked("gap", "high end of travel"),
    Regime.FIRST_QUARTER: marked("gap", "first quarter of a turn"),
    Regime.SECOND_QUARTER: marked("gap", "second quarter of a turn"),
    Regime.THIRD_QUARTER: marked("gap", "third quarter of a turn"),
    Regime.LAST_QUARTER: marked("gap", "last quarter of a turn"),
}
# Of the report that is being written: its drawings say as well what is to be seen.
_ENGLISH = Wording()
_wording: ContextVar[Wording] = ContextVar("wording", default=_ENGLISH)


@contextmanager
def worded(wording: Wording) -> Iterator[None]:
    """Use a wording while the context is active."""
    token = _wording.set(wording)
    try:
        yield
    finally:
        _wording.reset(token)


def said(template: str, **fields: str | float) -> str:
    """Return one of the report's texts in its language, with its fields filled."""
    return shown(Message("gap", template, tuple(fields.items())))


def shown(text: str) -> str:
    """Return a message or a number as the report writes it."""
    return _wording.get().shown(text)


def effect_title(effect_id: str) -> str:
    """Return an effect's name in the report; its id where it is not installed."""
    return said(UNKNOWN_EFFECT) if effect_id == UNKNOWN else named(english_title(effect_id))


def named(name: str) -> str:
    """Return an effect, a formulation or a stage as the report calls it."""
    return _wording.get().text("effects", name.replace("_", " "))


def english_title(effect_id: str) -> str:
    """Return an effect's name for people; its id where it is not installed."""
    if effect_id == UNKNOWN:
        return UNKNOWN_EFFECT
    try:
        return effect_named(effect_id).title
    except EffectError:
        return effect_id


def parameter_unit(parameter: FittedParameter, cause: Cause, records: Sequence[Record]) -> str:
    """Return the unit of a parameter, also where it depends on another axis."""
    source = cause.from_axis
    source_unit = unit_of(source, Tap.MEAS, records) if source is not None else ""
    return named_unit(parameter.unit, source_unit)
