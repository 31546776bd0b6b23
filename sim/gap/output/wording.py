"""A diagnosis in sentences: the causes, how far the gap shrinks, and the remainder."""

from collections.abc import Iterator, Sequence

from rotemina.sim.effects.errors import EffectError
from rotemina.sim.effects.registry import effect_named
from rotemina.sim.gap.diagnosis import UNKNOWN, AxisDiagnosis, Cause, Diagnosis, Shrinkage, Verdict
from rotemina.sim.gap.output.report.quantities import unit_of
from rotemina.sim.messages import AxisName, EffectName, Listed, Message, message
from rotemina.sim.quantities import amount
from rotemina.sim.records.record import Record, Tap

# Least probability, and what it is called.
LIKELIHOODS = (
    (0.95, message("gap", "very likely")),
    (0.75, message("gap", "likely")),
    (0.0, message("gap", "possible")),
)
# What a remainder may depend on, beside another axis.
GROUPS = {
    one.template: one
    for one in (
        message("gap", "command"),
        message("gap", "direction"),
        message("gap", "speed"),
        message("gap", "past commands"),
        message("gap", "time"),
        message("gap", "position phase"),
    )
}
_MOST_GROUPS = 2


def findings(diagnosis: Diagnosis) -> tuple[Message, ...]:
    """Return the causes of each axis with a gap of its own, one sentence per axis."""
    return tuple(_finding(one) for one in _speaking(diagnosis))


def details(diagnosis: Diagnosis, records: Sequence[Record]) -> tuple[Message, ...]:
    """Return how far the gap of each axis shrinks, the remainder, and axes without a gap."""
    said = [message for one in _speaking(diagnosis) for message in _details(one, records)]
    return (*said, *_quiet(diagnosis))


def summary(diagnosis: Diagnosis, records: Sequence[Record]) -> tuple[Message, ...]:
    """Return the whole answer, axis by axis, those with causes first."""
    said: list[Message] = []
    for one in _speaking(diagnosis):
        said += [_finding(one), *_details(one, records)]
    return (*said, *_quiet(diagnosis))


def _speaking(diagnosis: Diagnosis) -> list[AxisDiagnosis]:
    with_gap = [one for one in diagnosis.axes.values() if one.verdict is not Verdict.NONE]
    return sorted(with_gap, key=lambda one: not one.causes)


def _quiet(diagnosis: Diagnosis) -> Iterator[Message]:
    quiet = [AxisName(one.axis) for one in diagnosis.axes.values() if one.verdict is Verdict.NONE]
    if quiet:
        yield message("gap", "No gap of its own on {axes}.").fill(axes=Listed(tuple(quiet)))


def _named(one: AxisDiagnosis) -> list[Cause]:
    return [cause for cause in one.causes if cause.effect != UNKNOWN]


def _finding(one: AxisDiagnosis) -> Message:
    axis, named = AxisName(one.axis), _named(one)
    if one.verdict is Verdict.INSUFFICIENT:
        poor = message("gap", "{axis}: the records do not move the axis enough for a diagnosis.")
        return poor.fill(axis=axis)
    if not named:
        return message("gap", "{axis}: a gap that no known effect explains.").fill(axis=axis)
    if len(named) == 1 and not named[0].ambiguous_with:
        (cause,) = named
        said = message("gap", "{axis}: {cause}, {likelihood}.")
        return said.fill(axis=axis, cause=_effect(cause), likelihood=_likelihood(cause))
    causes = Listed(tuple(_cause(cause) for cause in named))
    return message("gap", "{axis}: {causes}.").fill(axis=axis, causes=causes)


def _cause(cause: Cause) -> Message:
    if cause.ambiguous_with:
        others = map(_titled, cause.ambiguous_with)
        effects = Listed((_effect(cause), *others), one_of_them=True)
        return message("gap", "{effects} (these records cannot distinguish them)").fill(
            effects=effects
        )
    said = message("gap", "{cause} ({likelihood})")
    return said.fill(cause=_effect(cause), likelihood=_likelihood(cause))


def _effect(cause: Cause) -> EffectName | Message:
    return effect_on(cause.effect, cause.from_axis)


def effect_on(effect: str, from_axis: str | None) -> EffectName | Message:
    """Return an effect as a sentence names it, with the axis that it comes from."""
    if from_axis is None:
        return _titled(effect)
    said = message("gap", "{effect} from {axis}")
    return said.fill(effect=_titled(effect), axis=AxisName(from_axis))


def _titled(effect: str) -> EffectName:
    try:
        return EffectName(effect, effect_named(effect).title)
    except EffectError:
        return EffectName(effect)  # of a plugin that is not installed


def _likelihood(cause: Cause) -> Message:
    return next(called for least, called in LIKELIHOODS if cause.probability >= least)


def _details(one: AxisDiagnosis, records: Sequence[Record]) -> Iterator[Message]:
    named = _named(one)
    for shrinkage in one.shrinkage[:1]:
        if named:
            yield _shrinks(shrinkage, len(named) > 1, records)
        else:
            said = message("gap", "{gap} is {raw} rms (noise floor {floor}).")
            yield said.fill(gap=_gap(shrinkage, begins=True), **_figures(shrinkage, records))
    if one.verdict in (Verdict.PARTLY, Verdict.UNKNOWN):
        yield _left(one)


def _shrinks(shrinkage: Shrinkage, several: bool, records: Sequence[Record]) -> Message:
    said = message(
        "gap",
        "Adding it to the model takes {gap} from {raw} to {corrected} rms on unseen data (noise "
        "floor {floor}).",
    )
    if several:
        said = message(
            "gap",
            "Adding them to the model takes {gap} from {raw} to {corrected} rms on unseen data "
            "(noise floor {floor}).",
        )
    corrected = amount(shrinkage.corrected, unit_of(shrinkage.axis, shrinkage.tap, records))
    return said.fill(gap=_gap(shrinkage), corrected=corrected, **_figures(shrinkage, records))


def _gap(shrinkage: Shrinkage, *, begins: bool = False) -> Message:
    """Return the name of the gap; a gap in the axis' own sensor needs no tap."""
    if shrinkage.tap is Tap.MEAS:
        return message("gap", "The gap") if begins else message("gap", "the gap")
    at_tap = message("gap", "The gap at {tap}") if begins else message("gap", "the gap at {tap}")
    return at_tap.fill(tap=str(shrinkage.tap))


def _figures(shrinkage: Shrinkage, records: Sequence[Record]) -> dict[str, str]:
    unit = unit_of(shrinkage.axis, shrinkage.tap, records)
    return {"raw": amount(shrinkage.raw, unit), "floor": amount(shrinkage.floor, unit)}


def _left(one: AxisDiagnosis) -> Message:
    depends = one.remainder.depends_on[:_MOST_GROUPS] if one.remainder is not None else ()
    if not depends:
        return message("gap", "No known effect explains the rest.")
    said = message("gap", "The rest depends on {groups}; no known effect explains it.")
    return said.fill(groups=Listed(tuple(group(name) for name, _ in depends)))


def group(name: str) -> Message:
    """Return a predictor of a remainder; another axis is named."""
    kind, _, axis = name.partition(" ")
    if kind == "axis":
        return message("gap", "axis {axis}").fill(axis=AxisName(axis))
    return GROUPS[name]
