"""Choice of the next experiment: the safe test on which rivals differ most.

Rivals are effects that the records cannot distinguish. Each is fitted to the records together with
the parameters of the model. On the chosen test, the predictions of the rivals differ most per row,
even after each rival has also been fitted to that test
(:mod:`~rotemina.sim.gap.experiment.separation`).
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial

import numpy as np

from rotemina.sim.gap.compare import Rival, not_ruled_out
from rotemina.sim.gap.examination import AxisExamination
from rotemina.sim.gap.experiment.safe_tests import (
    RICH_TEST,
    SafeTest,
    find_safe_tests,
    has_declared_limits,
)
from rotemina.sim.gap.experiment.separation import (
    AdaptableRival,
    Prediction,
    RivalSimulator,
    compute_fitted_separation,
    compute_fixed_separation,
    compute_linear_separation,
    find_close_rivals,
    scale_by_floors,
)
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.output import name_effect
from rotemina.sim.gap.result import (
    CORRECTING_VERDICTS,
    GapVerdict,
    SuggestedExperiment,
)
from rotemina.sim.messages import (
    AxisName,
    FieldList,
    Message,
    format_rounded,
    message,
)
from rotemina.sim.records import Tap
from rotemina.sim.robot import Robot
from rotemina.sim.units import format_quantity

_MAX_SETS = 2
_MAX_RIVALS = 4
# If the records rule nothing out, this many effects compete with the most likely effect.
_MAX_OPEN_RIVALS = 2
_FINALIST_COUNT = 4
# With at least this separation, in noise floors, a diagnosis distinguishes rivals.
_SUFFICIENT_SEPARATION_FLOORS = 1.0
# A test with a smaller separation is not suggested.
_MIN_SEPARATION_FLOORS = 0.05

Floors = Mapping[Tap, float]


def suggest_experiments(
    robot: Robot, examination: AxisExamination
) -> tuple[SuggestedExperiment, ...]:
    """Return a test for each set of effects that the records of an axis cannot distinguish.

    A test stays within the range of motion of the records. It uses the limits of the robot file
    only if no such test is sufficient, and if the file declares limits of speed and acceleration.

    Parameters
    ----------
    robot : Robot
        Its limits bound the tests.
    examination : AxisExamination

    Returns
    -------
    tuple of SuggestedExperiment
        Sets that no test separates are omitted. The tuple is empty for an axis that cannot follow
        commands.
    """
    sets = list(_find_open_sets(examination))
    if not sets and examination.verdict is not GapVerdict.INSUFFICIENT:
        return ()
    evidence = examination.evidence
    sources = [
        rival.from_axis for rivals in sets for rival in rivals if rival.from_axis is not None
    ]
    records = [observation.record for observation in evidence.observations]
    tests = find_safe_tests(robot, evidence.axis, records, sources)
    find_larger_tests = cache(
        partial(find_safe_tests, robot, evidence.axis, records, sources, beyond_records=True)
    )
    if not sets:
        # Larger tests come first, because motion like that of the records was not sufficient.
        rich_tests = [test for test in (*find_larger_tests(), *tests) if test.name == RICH_TEST]
        return tuple(_make_rich_experiment(evidence.axis, test) for test in rich_tests[:1])
    suggestions = [
        _make_experiment(examination, rivals, tests, find_larger_tests) for rivals in sets
    ]
    return tuple(experiment for experiment in suggestions if experiment is not None)


def _find_open_sets(examination: AxisExamination) -> Iterator[list[Rival]]:
    """Yield the sets of rivals that are not ruled out, up to a maximum.

    Records that move an axis too little rule nothing out. The set is then the most likely effects.
    """
    is_poor = examination.verdict is GapVerdict.INSUFFICIENT
    if not is_poor and examination.verdict not in CORRECTING_VERDICTS:
        return
    yielded_sets: list[set[str]] = []
    raw_power = examination.selection.raw
    for key, ranked in examination.ranked.items():
        most_likely = [rival.effect for rival in ranked if rival.effect != key[0]]
        others = dict.fromkeys(
            not_ruled_out(ranked, key, raw_power)
            or most_likely[: _MAX_OPEN_RIVALS if is_poor else 0]
        )
        names = {key[0], *others}
        if not others or names in yielded_sets or len(yielded_sets) == _MAX_SETS:
            continue
        yielded_sets.append(names)
        cause_rivals = [rival for rival in ranked if (rival.effect, rival.from_axis) == key]
        # An effect that was never fitted predicts nothing, so it is omitted.
        fitted_rivals = [
            next((rival for rival in ranked if rival.effect == name), None) for name in others
        ]
        other_rivals = [rival for rival in fitted_rivals if rival is not None]
        if other_rivals:
            yield [*cause_rivals, *other_rivals][:_MAX_RIVALS]


def _make_rich_experiment(axis: str, test: SafeTest) -> SuggestedExperiment:
    """Return a test for an axis whose records are too poor to name rivals."""
    record = test.record
    return SuggestedExperiment(
        axis=axis,
        splits=(),
        why=message(
            "gap",
            "The records move {axis} too little to distinguish effects. Play this: "
            "{test}; it covers many amplitudes and speeds.",
        ).fill(axis=AxisName(axis), test=describe_test(test, axis)),
        time_s=tuple(record.time_s.tolist()),
        commands={name: tuple(record.signal(name, Tap.CMD).tolist()) for name in record.axes},
        predictions={},
    )


@dataclass(frozen=True, slots=True, eq=False)
class _ChosenTest:
    """A test with the prediction of each rival, and the separation of the rivals in noise floors.

    ``floors`` has the noise floors of the taps that count. If no record has a reference,
    ``need_reference`` are the rivals that only a reference distinguishes.
    """

    test: SafeTest
    predictions: tuple[Prediction, ...]
    floors: Floors
    separation: float
    need_reference: tuple[Rival, ...] = ()

    @property
    def tap(self) -> Tap:
        """The reading if it separates the rivals sufficiently, or else the best tap."""
        if self.need_reference:
            return Tap.REF
        rows = len(self.test.record.time_s)

        def compute_separation(tap: Tap) -> float:
            floor = {tap: self.floors[tap]}
            return compute_fixed_separation(
                [scale_by_floors(prediction, floor) for prediction in self.predictions], rows
            )

        if Tap.MEAS in self.floors and compute_separation(Tap.MEAS) >= min(self.separation, 1.0):
            return Tap.MEAS
        return max(self.floors, key=compute_separation)

    def find_close_rivals(
        self, simulator: RivalSimulator, rivals: Sequence[Rival], floors: Floors, min_floors: float
    ) -> list[int]:
        """Return the indices of the rivals closer than ``min_floors`` to another rival."""
        adaptable_rivals = _adapt_rivals(simulator, rivals, self.test, self.predictions, floors)
        return find_close_rivals(adaptable_rivals, len(self.test.record.time_s), min_floors)


@dataclass(frozen=True, slots=True, eq=False)
class _RivalSeparation:
    """The best test for ``rivals``, and the rivals that were left out to find it."""

    choice: _ChosenTest
    rivals: Sequence[Rival]
    left_out: Sequence[Rival]


def _make_experiment(
    examination: AxisExamination,
    rivals: Sequence[Rival],
    tests: Sequence[SafeTest],
    find_larger_tests: Callable[[], Sequence[SafeTest]],
) -> SuggestedExperiment | None:
    """Return the best test for a set of rivals.

    It exceeds the motion of the records only if necessary.
    """
    evidence = examination.evidence
    sufficient_separation = _SUFFICIENT_SEPARATION_FLOORS * float(
        np.sqrt(max(examination.best.score, 1.0))
    )
    separation = _find_separation(evidence, rivals, tests, sufficient_separation)
    if (
        separation is None
        or separation.left_out
        or separation.choice.separation < sufficient_separation
    ):
        larger_separation = _find_separation(
            evidence, rivals, find_larger_tests(), sufficient_separation
        )
        if separation is None or (
            larger_separation is not None
            and larger_separation.choice.separation > separation.choice.separation
        ):
            separation = larger_separation
    if separation is None or separation.choice.separation < _MIN_SEPARATION_FLOORS:
        return None
    choice, record = separation.choice, separation.choice.test.record
    return SuggestedExperiment(
        axis=evidence.axis,
        splits=tuple(rival.effect for rival in separation.rivals),
        why=_explain_choice(
            evidence, separation, is_doubtful=choice.separation < sufficient_separation
        ),
        time_s=tuple(record.time_s.tolist()),
        commands={name: tuple(record.signal(name, Tap.CMD).tolist()) for name in record.axes},
        predictions={
            rival.effect: tuple(prediction[choice.tap].tolist())
            for rival, prediction in zip(separation.rivals, choice.predictions, strict=True)
        },
        tap=choice.tap,
    )


def _find_separation(
    evidence: Evidence, rivals: Sequence[Rival], tests: Sequence[SafeTest], min_separation: float
) -> _RivalSeparation | None:
    simulator = RivalSimulator(evidence.robot, evidence.axis, evidence.heartbeat)
    rivals, left_out = list(rivals), []
    choice = _choose_test(simulator, evidence, rivals, tests, min_separation)
    while choice is not None and choice.separation < min_separation and len(rivals) > 2:
        close_indices = choice.find_close_rivals(simulator, rivals, choice.floors, min_separation)
        left_out.append(rivals.pop(max(close_indices, default=0) or len(rivals) - 1))
        choice = _choose_test(simulator, evidence, rivals, tests, min_separation)
    return None if choice is None else _RivalSeparation(choice, rivals, left_out)


def _choose_test(
    simulator: RivalSimulator,
    evidence: Evidence,
    rivals: Sequence[Rival],
    tests: Sequence[SafeTest],
    min_separation: float,
) -> _ChosenTest | None:
    simulated = list(_simulate_safe_tests(simulator, rivals, tests))
    floors = _find_floors(evidence)
    choice = _find_best_test(simulator, rivals, simulated, floors)
    if Tap.REF in floors or (choice is not None and choice.separation >= min_separation):
        return choice
    floors_with_reference = {**floors, Tap.REF: _find_reference_floor(evidence, floors)}
    with_reference = _find_best_test(simulator, rivals, simulated, floors_with_reference)
    if with_reference is None or with_reference.separation < min_separation:
        return choice
    close_indices = with_reference.find_close_rivals(simulator, rivals, floors, min_separation)
    return replace(with_reference, need_reference=tuple(rivals[index] for index in close_indices))


def _simulate_safe_tests(
    simulator: RivalSimulator, rivals: Sequence[Rival], tests: Sequence[SafeTest]
) -> Iterator[tuple[SafeTest, tuple[Prediction, ...]]]:
    for test in tests:
        predictions = [
            simulator.simulate(rival.explanation.fit.effects, test.record) for rival in rivals
        ]
        safe_predictions = [
            prediction
            for prediction in predictions
            if prediction is not None and simulator.stays_in_range(prediction)
        ]
        if len(safe_predictions) == len(rivals):
            yield test, tuple(safe_predictions)


def _find_best_test(
    simulator: RivalSimulator,
    rivals: Sequence[Rival],
    simulated: Sequence[tuple[SafeTest, tuple[Prediction, ...]]],
    floors: Floors,
) -> _ChosenTest | None:
    def compute_separation(simulated_test: tuple[SafeTest, tuple[Prediction, ...]]) -> float:
        test, predictions = simulated_test
        rows = len(test.record.time_s)
        return compute_fixed_separation(
            [scale_by_floors(prediction, floors) for prediction in predictions], rows
        )

    finalists = []
    for test, predictions in sorted(simulated, key=compute_separation, reverse=True)[
        :_FINALIST_COUNT
    ]:
        adaptable_rivals = _adapt_rivals(simulator, rivals, test, predictions, floors)
        separation = compute_linear_separation(adaptable_rivals, len(test.record.time_s))
        finalists.append((_ChosenTest(test, predictions, floors, separation), adaptable_rivals))
    best: _ChosenTest | None = None
    for finalist, adaptable_rivals in sorted(finalists, key=lambda pair: -pair[0].separation):
        if best is None or finalist.separation > best.separation:
            separation = min(
                finalist.separation,
                compute_fitted_separation(adaptable_rivals, len(finalist.test.record.time_s)),
            )
            fitted_test = replace(finalist, separation=separation)
            best = fitted_test if best is None or fitted_test.separation > best.separation else best
    return best


def _adapt_rivals(
    simulator: RivalSimulator,
    rivals: Sequence[Rival],
    test: SafeTest,
    predictions: Sequence[Prediction],
    floors: Floors,
) -> list[AdaptableRival]:
    return [
        AdaptableRival.of(simulator, rival.explanation.fit, test.record, prediction, floors)
        for rival, prediction in zip(rivals, predictions, strict=True)
    ]


def _find_floors(evidence: Evidence) -> dict[Tap, float]:
    squares: dict[Tap, list[float]] = {}
    for observation in evidence.observations:
        for tap, floor in observation.floor.items():
            squares.setdefault(tap, []).append(floor**2)
    return {tap: float(np.sqrt(np.mean(tap_squares))) for tap, tap_squares in squares.items()}


def _find_reference_floor(evidence: Evidence, floors: Floors) -> float:
    """Return the declared noise of a reference, or else the floor of a recorded tap."""
    noise = evidence.robot.reference.noise_rms
    unit = evidence.observations[0].record.units[evidence.axis]
    declared = noise.angular if unit == "rad" else noise.linear
    return declared or floors.get(Tap.MEAS) or min(floors.values())


def _explain_choice(
    evidence: Evidence, separation: _RivalSeparation, *, is_doubtful: bool
) -> Message:
    axis, choice, rivals = evidence.axis, separation.choice, separation.rivals
    template = message(
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
    has_limits = has_declared_limits(evidence.robot, axis)
    reference = message(
        "gap",
        ", if the reference (ref) of {axis} is recorded too: without it, the test "
        "does not distinguish {effects}",
    ).fill(axis=AxisName(axis), effects=_list_rivals(choice.need_reference))
    others = message("gap", "; no test here distinguishes {any} from one of them")
    return template.fill(
        effects=_list_rivals(rivals),
        test=describe_test(choice.test, axis),
        closest=closest if len(rivals) > 2 else "",
        n=format_rounded(choice.separation, 2),
        doubt=doubt if is_doubtful else "",
        limits=limits if is_doubtful and not has_limits else "",
        reference=reference if choice.need_reference else "",
        others=others.fill(any=_list_rivals(separation.left_out, one_of_them=True))
        if separation.left_out
        else "",
    )


def _list_rivals(rivals: Sequence[Rival], *, one_of_them: bool = False) -> FieldList:
    return FieldList(
        tuple(name_effect(rival.effect, rival.from_axis) for rival in rivals), one_of_them
    )


def describe_test(test: SafeTest, axis: str) -> Message:
    """Return the name of a test with its size, centre and duration, as used in a sentence."""
    record = test.record
    moving_axis = next(
        (
            moved_axis
            for moved_axis in record.axes
            if np.ptp(record.signal(moved_axis, Tap.CMD)) > 0.0
        ),
        axis,
    )
    command = record.signal(moving_axis, Tap.CMD)
    low, high = float(command.min()), float(command.max())
    size, middle = (
        format_quantity(value, record.units[moving_axis], digits=digits)
        for value, digits in (((high - low) / 2.0, 3), ((high + low) / 2.0, 4))
    )
    template = message("gap", "{name}, ±{size} about {middle}, {time} s")
    time = format_rounded(record.duration_s, 3)
    return template.fill(name=test.name, size=size, middle=middle, time=time)
