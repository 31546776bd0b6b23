"""The next experiment: the safe test on which rivals differ most.

Rivals are effects that the records cannot distinguish, each fitted to the records together with the
model's own parameters. On the chosen test their answers differ most per row, and so per second,
after each rival has also been fitted to that test:
see :mod:`~rotemina.sim.gap.experiment.separation`.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial

import numpy as np

from rotemina.sim.gap.compare.rivals import Rival, not_ruled_out
from rotemina.sim.gap.diagnosis import CORRECTING, Experiment, Verdict
from rotemina.sim.gap.examination import Examination
from rotemina.sim.gap.experiment.safe_tests import RICH, Trial, has_declared_limits, trials
from rotemina.sim.gap.experiment.separation import (
    Answer,
    Player,
    Yielding,
    alike,
    apart,
    apart_by_fit,
    over_floors,
    plainly_apart,
)
from rotemina.sim.gap.fit.evidence import Evidence
from rotemina.sim.gap.output.wording import effect_on
from rotemina.sim.messages import AxisName, Listed, Message, message
from rotemina.sim.quantities import amount, rounded
from rotemina.sim.records.record import Tap
from rotemina.sim.robot.model import Robot

_MOST_SETS = 2
_MOST_RIVALS = 4
_OPEN = 2  # effects beside the likeliest one, where the records rule none out
_FINALISTS = 4
_ENOUGH = 1.0  # floors apart, from which a diagnosis tells rivals
_NOTHING = 0.05  # floors apart, below which a test is none

Floors = Mapping[Tap, float]


def experiments(robot: Robot, examination: Examination) -> tuple[Experiment, ...]:
    """Return a test for each set of effects that the records of an axis cannot distinguish.

    A test stays inside the motion that the records show. It goes up to the limits of the robot file
    only if no such test is enough, and the file states limits of speed and acceleration.

    Parameters
    ----------
    robot : Robot
        Within whose limits the tests stay.
    examination : Examination

    Returns
    -------
    tuple of Experiment
        None for sets that no test here splits, and for an axis that nothing makes follow commands.
    """
    sets = list(_sets(examination))
    if not sets and examination.verdict is not Verdict.INSUFFICIENT:
        return ()
    evidence = examination.evidence
    sources = [one.from_axis for own in sets for one in own if one.from_axis is not None]
    records = [one.record for one in evidence.observations]
    able = trials(robot, evidence.axis, records, sources)
    beyond = cache(partial(trials, robot, evidence.axis, records, sources, beyond_records=True))
    if not sets:
        # Motion like that of the records is known to be too little.
        rich = [one for one in (*beyond(), *able) if one.name == RICH]
        return tuple(_rich(evidence.axis, one) for one in rich[:1])
    found = [_experiment(examination, own, able, beyond) for own in sets]
    return tuple(one for one in found if one is not None)


def _sets(examination: Examination) -> Iterator[list[Rival]]:
    """Give the sets of rivals that are open, at most a few.

    Records that move an axis too little rule nothing out: the likeliest few are open then.
    """
    poor = examination.verdict is Verdict.INSUFFICIENT
    if not poor and examination.verdict not in CORRECTING:
        return
    seen: list[set[str]] = []
    raw = examination.selection.raw
    for key, ranked in examination.ranked.items():
        likeliest = [one.effect for one in ranked if one.effect != key[0]]
        others = dict.fromkeys(not_ruled_out(ranked, key, raw) or likeliest[: _OPEN if poor else 0])
        names = {key[0], *others}
        if not others or names in seen or len(seen) == _MOST_SETS:
            continue
        seen.append(names)
        own = [one for one in ranked if (one.effect, one.from_axis) == key]
        # What stands for another without having been fitted predicts nothing.
        first = [next((one for one in ranked if one.effect == name), None) for name in others]
        rest = [one for one in first if one is not None]
        if rest:
            yield [*own, *rest][:_MOST_RIVALS]


def _rich(axis: str, trial: Trial) -> Experiment:
    """Return a test for an axis whose records are too poor to have rivals."""
    record = trial.record
    return Experiment(
        axis=axis,
        splits=(),
        why=message(
            "gap",
            "The records move {axis} too little to distinguish effects. Play this: "
            "{test}; it covers many amplitudes and speeds.",
        ).fill(axis=AxisName(axis), test=_described(trial, axis)),
        time_s=tuple(record.time_s.tolist()),
        commands={name: tuple(record.signal(name, Tap.CMD).tolist()) for name in record.axes},
        predictions={},
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Choice:
    """A test, the answer of each rival, and by how many floors of which taps they differ.

    ``need_reference`` are rivals that only a reference distinguishes, which no record has.
    """

    trial: Trial
    answers: tuple[Answer, ...]
    floors: Floors
    apart: float
    need_reference: tuple[Rival, ...] = ()

    @property
    def tap(self) -> Tap:
        """The tap with the most informative predictions: the reading if that suffices."""
        if self.need_reference:
            return Tap.REF
        rows = len(self.trial.record.time_s)

        def tells(tap: Tap) -> float:
            own = {tap: self.floors[tap]}
            return plainly_apart([over_floors(answer, own) for answer in self.answers], rows)

        if Tap.MEAS in self.floors and tells(Tap.MEAS) >= min(self.apart, 1.0):
            return Tap.MEAS
        return max(self.floors, key=tells)

    def alike(
        self, player: Player, rivals: Sequence[Rival], floors: Floors, least: float
    ) -> list[int]:
        """Return the numbers of the rivals that this test sets less than ``least`` floors apart."""
        yielding = _yielding(player, rivals, self.trial, self.answers, floors)
        return alike(yielding, len(self.trial.record.time_s), least)


@dataclass(frozen=True, slots=True, eq=False)
class _Separation:
    """The best test for some rivals, without those that it does not separate."""

    choice: _Choice
    rivals: Sequence[Rival]
    left_out: Sequence[Rival]


def _experiment(
    examination: Examination,
    rivals: Sequence[Rival],
    able: Sequence[Trial],
    beyond: Callable[[], Sequence[Trial]],
) -> Experiment | None:
    """Return the best test for a set; one that goes beyond the records if no other is enough."""
    evidence = examination.evidence
    enough = _ENOUGH * float(np.sqrt(max(examination.best.score, 1.0)))
    found = _separation(evidence, rivals, able, enough)
    if found is None or found.left_out or found.choice.apart < enough:
        other = _separation(evidence, rivals, beyond(), enough)
        if found is None or (other is not None and other.choice.apart > found.choice.apart):
            found = other
    if found is None or found.choice.apart < _NOTHING:
        return None
    choice, record = found.choice, found.choice.trial.record
    return Experiment(
        axis=evidence.axis,
        splits=tuple(one.effect for one in found.rivals),
        why=_why(evidence, found, doubtful=choice.apart < enough),
        time_s=tuple(record.time_s.tolist()),
        commands={name: tuple(record.signal(name, Tap.CMD).tolist()) for name in record.axes},
        predictions={
            one.effect: tuple(answer[choice.tap].tolist())
            for one, answer in zip(found.rivals, choice.answers, strict=True)
        },
        tap=choice.tap,
    )


def _separation(
    evidence: Evidence, rivals: Sequence[Rival], able: Sequence[Trial], enough: float
) -> _Separation | None:
    """Return the best of some tests; members of the set that none separates are left out."""
    player = Player(evidence.robot, evidence.axis, evidence.heartbeat)
    rivals, left_out = list(rivals), []
    choice = _choice(player, evidence, rivals, able, enough)
    while choice is not None and choice.apart < enough and len(rivals) > 2:
        close = choice.alike(player, rivals, choice.floors, enough)
        left_out.append(rivals.pop(max(close, default=0) or len(rivals) - 1))
        choice = _choice(player, evidence, rivals, able, enough)
    return None if choice is None else _Separation(choice, rivals, left_out)


def _choice(
    player: Player,
    evidence: Evidence,
    rivals: Sequence[Rival],
    able: Sequence[Trial],
    enough: float,
) -> _Choice | None:
    """Return the best test by the channels that records have; by a reference if need be."""
    played = list(_played(player, rivals, able))
    floors = _floors(evidence)
    choice = _best(player, rivals, played, floors)
    if Tap.REF in floors or (choice is not None and choice.apart >= enough):
        return choice
    more = {**floors, Tap.REF: _floor_of_reference(evidence, floors)}
    other = _best(player, rivals, played, more)
    if other is None or other.apart < enough:
        return choice
    close = other.alike(player, rivals, floors, enough)
    return replace(other, need_reference=tuple(rivals[number] for number in close))


def _played(
    player: Player, rivals: Sequence[Rival], able: Sequence[Trial]
) -> Iterator[tuple[Trial, tuple[Answer, ...]]]:
    """Give tests that are safe whichever rival is right, and what each says of them."""
    for trial in able:
        answers = [player.answer(one.explanation.fit.effects, trial.record) for one in rivals]
        sound = [one for one in answers if one is not None and player.stays_inside(one)]
        if len(sound) == len(rivals):
            yield trial, tuple(sound)


def _best(
    player: Player,
    rivals: Sequence[Rival],
    played: Sequence[tuple[Trial, tuple[Answer, ...]]],
    floors: Floors,
) -> _Choice | None:
    """Return the test that sets the rivals farthest apart, at these taps together."""

    def plainly(one: tuple[Trial, tuple[Answer, ...]]) -> float:
        trial, answers = one
        rows = len(trial.record.time_s)
        return plainly_apart([over_floors(answer, floors) for answer in answers], rows)

    finalists = []
    for trial, answers in sorted(played, key=plainly, reverse=True)[:_FINALISTS]:
        yielding = _yielding(player, rivals, trial, answers, floors)
        rms = apart(yielding, len(trial.record.time_s))
        finalists.append((_Choice(trial, answers, floors, rms), yielding))
    best: _Choice | None = None
    for one, yielding in sorted(finalists, key=lambda each: -each[0].apart):
        if best is None or one.apart > best.apart:
            rms = min(one.apart, apart_by_fit(yielding, len(one.trial.record.time_s)))
            fitted = replace(one, apart=rms)
            best = fitted if best is None or fitted.apart > best.apart else best
    return best


def _yielding(
    player: Player,
    rivals: Sequence[Rival],
    trial: Trial,
    answers: Sequence[Answer],
    floors: Floors,
) -> list[Yielding]:
    return [
        Yielding.of(player, one.explanation.fit, trial.record, answer, floors)
        for one, answer in zip(rivals, answers, strict=True)
    ]


def _floors(evidence: Evidence) -> dict[Tap, float]:
    """Return the floor of each tap that records have, SI."""
    squares: dict[Tap, list[float]] = {}
    for observation in evidence.observations:
        for tap, floor in observation.floor.items():
            squares.setdefault(tap, []).append(floor**2)
    return {tap: float(np.sqrt(np.mean(own))) for tap, own in squares.items()}


def _floor_of_reference(evidence: Evidence, floors: Floors) -> float:
    """Return the floor of a reference that no record has: as declared, or the finest known."""
    noise = evidence.robot.reference.noise_rms
    unit = evidence.observations[0].record.units[evidence.axis]
    declared = noise.angular if unit == "rad" else noise.linear
    return declared or floors.get(Tap.MEAS) or min(floors.values())


def _why(evidence: Evidence, found: _Separation, *, doubtful: bool) -> Message:
    axis, choice, rivals = evidence.axis, found.choice, found.rivals
    said = message(
        "gap",
        "To distinguish {effects}, play this: {test}; it separates them{closest} by"
        " {n} noise floors (rms), even after each is fitted to "
        "it{doubt}{limits}{reference}{others}.",
    )
    closest = message("gap", ", the closest two of them,")
    doubt = message("gap", ", which may be too little")
    limits = message(
        "gap",
        ": it is no faster than the records, because the robot file states no max_speed and "
        "max_acceleration for {axis}",
    ).fill(axis=AxisName(axis))
    bounded = has_declared_limits(evidence.robot, axis)
    reference = message(
        "gap",
        ", if the reference (ref) of {axis} is recorded too: without it, the test "
        "does not distinguish {effects}",
    ).fill(axis=AxisName(axis), effects=_listed(choice.need_reference))
    others = message("gap", "; no test here distinguishes {any} from one of them")
    return said.fill(
        effects=_listed(rivals),
        test=_described(choice.trial, axis),
        closest=closest if len(rivals) > 2 else "",
        n=rounded(choice.apart, 2),
        doubt=doubt if doubtful else "",
        limits=limits if doubtful and not bounded else "",
        reference=reference if choice.need_reference else "",
        others=others.fill(any=_listed(found.left_out, one_of_them=True)) if found.left_out else "",
    )


def _listed(rivals: Sequence[Rival], *, one_of_them: bool = False) -> Listed:
    return Listed(tuple(effect_on(one.effect, one.from_axis) for one in rivals), one_of_them)


def _described(trial: Trial, axis: str) -> Message:
    """Return a test in words: what moves, by how much, for how long."""
    record = trial.record
    moved = next((one for one in record.axes if np.ptp(record.signal(one, Tap.CMD)) > 0.0), axis)
    command = record.signal(moved, Tap.CMD)
    low, high = float(command.min()), float(command.max())
    size, middle = (
        amount(value, record.units[moved], digits=digits)
        for value, digits in (((high - low) / 2.0, 3), ((high + low) / 2.0, 4))
    )
    said = message("gap", "{name}, ±{size} about {middle}, {time} s")
    time = rounded(record.duration_s, 3)
    return said.fill(name=trial.name, size=size, middle=middle, time=time)
