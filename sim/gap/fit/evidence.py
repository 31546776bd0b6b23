"""Evidence: the records of one axis, and the answers of a model with given effects.

The constant part of a difference is not evidence: the offset of a record is a nuisance.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import NamedTuple, Self

import numpy as np

from rotemina.sim.arrays import (
    BoolArray,
    FloatArray,
    IntArray,
)
from rotemina.sim.effects import AttachedEffect, RecordCoverage, load_effect
from rotemina.sim.errors import GapError
from rotemina.sim.gap.fit.noise_floors import floors
from rotemina.sim.gap.fit.reading_cells import beyond
from rotemina.sim.gap.fit.row_blocks import block_numbers
from rotemina.sim.gap.fit.start_state import other_starts, start
from rotemina.sim.plant import Plant, PlantState, RunCommands, check_axes, compute_motion, make_run
from rotemina.sim.records import Record, Tap
from rotemina.sim.robot import (
    AxisEffect,
    ForceAxis,
    Robot,
)

_TAPS = (Tap.U, Tap.REF, Tap.MEAS)
_FORGETS = 8  # part of a record, by whose end most axes have forgotten how it began
_FORGOTTEN = 0.01  # floors, within which two answers are one
_CONSTANT_FORCE = 0.1  # of a constant force, that is held against the model

Signals = Mapping[Tap, FloatArray]


class Part(NamedTuple):
    """Which rows of a residual belong to a tap of a record."""

    record: int
    tap: Tap
    rows: slice


@dataclass(frozen=True, slots=True, eq=False)
class Observation:
    """The part of one record that concerns one axis.

    ``real`` (n,) per tap, SI; ``floor`` rms per tap of what no model can explain; ``kept`` (n,)
    per tap tells which rows a fit may trust, all where a tap is missing; ``nuisance`` (n, m) are
    signals that are this record's own, in whatever amount, beside its offset. Of a tap that reads
    in coarse steps ``cell`` is their width, SI: there, only what lies beyond a cell is a gap.
    ``origin``, m or rad, is where the record begins to count its place, as others count it.
    ``weight`` (n,) per tap says by how much rows count, 1 where a tap is missing.
    """

    record: Record
    real: Signals
    floor: Mapping[Tap, float]
    kept: Mapping[Tap, BoolArray] = field(default_factory=dict)
    nuisance: FloatArray | None = None
    cell: Mapping[Tap, float] = field(default_factory=dict)
    origin: float = 0.0
    weight: Mapping[Tap, FloatArray] = field(default_factory=dict)

    @property
    def taps(self) -> tuple[Tap, ...]:
        """The taps that were measured, in the order of the chain."""
        return tuple(self.real)


def _unheard() -> None:
    """Do nothing."""


def _ignore_failure(_effects: Sequence[AxisEffect], _error: Exception) -> None:
    """Do nothing."""


@dataclass(frozen=True, slots=True, eq=False)
class Evidence:
    """All records of one axis of a robot; the robot's effects are part of the model.

    ``heartbeat`` is called before every simulation; its exceptions end the running work.
    ``note_failure`` is called with the effects of a candidate whose computation failed.
    """

    robot: Robot
    axis: str
    observations: tuple[Observation, ...]
    heartbeat: Callable[[], None] = _unheard
    note_failure: Callable[[Sequence[AxisEffect], Exception], None] = _ignore_failure
    _runs: dict[tuple[int, tuple[str, ...]], RunCommands] = field(default_factory=dict)
    _own: dict[tuple[int, Tap], FloatArray] = field(default_factory=dict)

    @classmethod
    def of(cls, robot: Robot, axis: str, records: Sequence[Record]) -> Self:
        """Gather what records say of an axis.

        Raises
        ------
        GapError
            If none of them measures it.
        PlantError
            If a record does not fit the robot.
        """
        observations = []
        for record in records:
            if axis not in record.axes:
                continue
            check_axes(robot, record)
            observation = _observe(robot, axis, record)
            if observation.real:
                observations.append(observation)
        if not observations:
            raise GapError(
                "axis {axis}: no record holds a measured channel of it (u, ref or meas) whose "
                "noise floor is known or can be measured; nothing can be compared",
                axis=repr(axis),
            )
        return cls(robot, axis, tuple(observations))

    def __reduce__(self) -> tuple[object, ...]:
        """Leave out what another process has no use for.

        Threads go on filling the caches while evidence is sent to a cluster, and whoever hears of
        the heartbeat is here.
        """
        return Evidence, (self.robot, self.axis, self.observations)

    def with_model(self, robot: Robot) -> "Evidence":
        """Return the same evidence with another model of the machine."""
        return Evidence(robot, self.axis, self.observations, self.heartbeat, self.note_failure)

    def with_observations(self, observations: Sequence[Observation]) -> "Evidence":
        """Return evidence of other observations of the same axis."""
        return Evidence(
            self.robot, self.axis, tuple(observations), self.heartbeat, self.note_failure
        )

    def has(self, tap: Tap) -> bool:
        """Tell whether any record holds a tap."""
        return any(tap in observation.real for observation in self.observations)

    def floor(self, tap: Tap) -> float:
        """Return the noise floor of a tap, SI: the quadratic mean of those of the records.

        It is that of the rows that are kept: the others are zeros in a residual, whose mean is
        over all rows.
        """
        floors = [
            o.floor[tap] / np.sqrt(o.kept[tap].mean() if tap in o.kept else 1.0)
            for o in self.observations
            if tap in o.floor
        ]
        return float(np.sqrt(np.mean(np.square(floors))))

    def unweighted(self) -> "Evidence":
        """Return the same evidence with all rows counting alike."""
        if not any(one.weight for one in self.observations):
            return self
        return self.with_observations([replace(one, weight={}) for one in self.observations])

    @property
    def in_cells(self) -> bool:
        """Whether coarse readings of any record count by their cells."""
        return any(observation.cell for observation in self.observations)

    @property
    def reach(self) -> tuple[float, float]:
        """The least and the greatest command, m or rad."""
        commands = [o.record.signal(self.axis, Tap.CMD) for o in self.observations]
        return min(float(c.min()) for c in commands), max(float(c.max()) for c in commands)

    @property
    def extent(self) -> RecordCoverage:
        """What the records cover."""
        return RecordCoverage(self.reach, max(o.record.duration_s for o in self.observations))

    @property
    def parts(self) -> list[Part]:
        """The taps of all records in the order in which :meth:`residual` strings them together."""
        parts, begin = [], 0
        for number, observation in enumerate(self.observations):
            for tap, real in observation.real.items():
                parts.append(Part(number, tap, slice(begin, begin + len(real))))
                begin += len(real)
        return parts

    def residual(
        self, effects: Sequence[AxisEffect] = (), only: Sequence[int] | None = None
    ) -> FloatArray:
        """Return real minus model (rows,) over the floor, without nuisances; 0 in rows not kept.

        ``only`` names records; all of them by default.
        """
        left = []
        for number, (answer, *others) in self._answers(effects, only):
            observation = self.observations[number]
            for tap, real in observation.real.items():
                apart = [real - answer[tap], *(other[tap] - answer[tap] for other in others)]
                floor = observation.floor[tap]
                gap, *memory = (self.without_nuisance(number, tap, x / floor) for x in apart)
                gap = beside(memory, gap)
                if tap is Tap.U and not self._by_force:
                    own = partial(self.without_nuisance, number, tap)
                    gap = within_a_row(gap, answer[tap] / floor, own)
                if tap in observation.cell:
                    half = 0.5 * observation.cell[tap] / floor
                    gap = beyond(gap, half, observation.kept.get(tap))
                left.append(gap)
        return np.concatenate(left)

    def without_nuisance(self, number: int, tap: Tap, gap: FloatArray) -> FloatArray:
        """Return a gap (n,) over the floor of a tap without what is the record's own.

        That is its offset and its nuisance signals; rows that are not kept are 0.
        """
        observation = self.observations[number]
        kept = observation.kept.get(tap)
        weight = observation.weight.get(tap)
        if kept is None and observation.nuisance is None and weight is None:
            return np.asarray(_centred(gap) + self._constant(tap, gap))
        key = number, tap
        if key not in self._own:
            self._own[key] = _own_signals(observation, kept, weight, len(gap))
        basis = self._own[key]
        if kept is not None:
            gap = np.where(kept, gap, 0.0)
        if weight is not None:
            gap = gap * weight
        return np.asarray(gap - basis @ (basis.T @ gap) + self._constant(tap, gap))

    @property
    def _by_force(self) -> bool:
        """Whether the axis is moved by a force, which its controller computes from a reading."""
        return isinstance(self.robot.axes[self.axis], ForceAxis)

    def _constant(self, tap: Tap, gap: FloatArray) -> float:
        """Return how much of a constant gap is held against the model after all.

        At the effort of a controller it is no offset of a sensor but a constant force. Friction
        that differs by direction could play its part, but is not to where nothing speaks for it.
        """
        of_force = tap is Tap.U and self._by_force
        return _CONSTANT_FORCE * float(gap.mean()) if of_force else 0.0

    def response(
        self, effects: Sequence[AxisEffect] = (), only: Sequence[int] | None = None
    ) -> list[Signals]:
        """Return the answers of the model with further effects to all records, or to some.

        Raises
        ------
        EffectError, PlantError
            If it cannot be simulated.
        """
        return [answer for _, (answer, *_) in self._answers(effects, only)]

    def remembering(self, effects: Sequence[AxisEffect] = ()) -> list[Signals]:
        """Return the answers of the model to each record, with the best-fitting memory.

        Where the history of a record is unknown, the memory of the axis at its first row is a
        nuisance of the record, as in :meth:`residual`.

        Raises
        ------
        EffectError, PlantError
            If it cannot be simulated.
        """
        found: list[Signals] = []
        for number, (answer, *others) in self._answers(effects, None):
            observation, remembered = self.observations[number], dict(answer)
            for tap, real in observation.real.items():
                floor = observation.floor[tap]
                memory = [(other[tap] - answer[tap]) / floor for other in others]
                if memory:
                    gap, *signals = (
                        self.without_nuisance(number, tap, x)
                        for x in ((real - answer[tap]) / floor, *memory)
                    )
                    amounts = _amounts(signals, gap)
                    remembered[tap] = answer[tap] + floor * (np.stack(memory, axis=1) @ amounts)
            found.append(remembered)
        return found

    def _answers(
        self, effects: Sequence[AxisEffect], only: Sequence[int] | None
    ) -> Iterator[tuple[int, list[Signals]]]:
        """Give the number of each record, and the answers from its start and from other ones."""
        self.heartbeat()
        robot = replace(self.robot, effects=(*self.robot.effects, *effects))
        plants: dict[tuple[bool, float], Plant] = {}
        for number in range(len(self.observations)) if only is None else only:
            observation = self.observations[number]
            record = observation.record
            key = record.closed_loop, observation.origin
            if key not in plants:
                seen = _moved(robot, self.axis, observation.origin)
                plants[key] = Plant.of(seen, closed_loop=record.closed_loop, only={self.axis})
            plant = plants[key]
            run = self._run(number, plant)
            answer = self._answer(plant, run, start(plant, record, run), observation)
            others = [
                self._until_forgotten(plant, run, state, observation, answer)
                for state in other_starts(plant, record, run, self.axis)
            ]
            yield number, [answer, *others]

    def _until_forgotten(
        self,
        plant: Plant,
        run: RunCommands,
        state: PlantState,
        observation: Observation,
        answer: Signals,
    ) -> Signals:
        """Return the answer from another start, simulated no farther than that start matters."""
        rows = len(run.time_s) // _FORGETS
        begun = self._answer(plant, RunCommands(*(one[:rows] for one in run)), state, observation)
        last = slice(rows - rows // 4, rows)
        for tap, signal in begun.items():
            apart = np.abs(signal[last] - answer[tap][last]).max(initial=0.0)
            if rows < 8 or apart > _FORGOTTEN * observation.floor[tap]:
                return self._answer(plant, run, state, observation)
        return {tap: np.concatenate([signal, answer[tap][rows:]]) for tap, signal in begun.items()}

    def _answer(
        self, plant: Plant, run: RunCommands, state: PlantState, observation: Observation
    ) -> Signals:
        motion = compute_motion(plant, state, run)
        column = plant.axes.index(self.axis)
        signals = (motion.inputs, motion.position, motion.reading)
        taps = zip(_TAPS, (signal[:, column] for signal in signals), strict=True)
        return {tap: signal for tap, signal in taps if tap in observation.real}

    def gaps(self, effects: Sequence[AxisEffect] = ()) -> list[Signals]:
        """Return real minus model of each record and tap, without its mean, over the floor."""
        gaps: list[Signals] = []
        for observation, answer in zip(self.observations, self.response(effects), strict=True):
            found = {}
            for tap, real in observation.real.items():
                floor = observation.floor[tap]
                found[tap] = _centred(real - answer[tap]) / floor
                if tap is Tap.U and not self._by_force:
                    found[tap] = within_a_row(found[tap], answer[tap] / floor, _centred)
            gaps.append(found)
        return gaps

    def _run(self, number: int, plant: Plant) -> RunCommands:
        key = number, plant.axes
        if key not in self._runs:
            self._runs[key] = make_run(plant, self.observations[number].record)
        return self._runs[key]


def block_rows(evidence: Evidence) -> IntArray:
    """Return the block (rows,) of each row of a residual, the same one for all taps."""
    numbers: dict[int, IntArray] = {}
    begin = 0
    for number, observation in enumerate(evidence.observations):
        record = observation.record
        own = block_numbers(record.time_s, record.signal(evidence.axis, Tap.CMD))
        numbers[number] = own + begin
        begin = int(numbers[number].max()) + 1
    return np.concatenate([numbers[part.record] for part in evidence.parts])


def _observe(robot: Robot, axis: str, record: Record) -> Observation:
    floor = floors(robot, record, axis)
    return Observation(record, {tap: record.signal(axis, tap) for tap in floor}, floor)


def _moved(robot: Robot, axis: str, origin: float) -> Robot:
    """Return a robot whose axis counts its place from elsewhere."""
    if origin == 0.0:
        return robot
    effects = []
    for asked in robot.effects:
        moved = load_effect(asked.id).identification.moved
        if moved is not None and asked.axis == axis:
            values = AttachedEffect.of(robot, asked).values
            asked = replace(asked, parameters=dict(moved(values, origin)))
        effects.append(asked)
    return replace(robot, effects=tuple(effects))


def beside(signals: Sequence[FloatArray], gap: FloatArray) -> FloatArray:
    """Return a gap (n,) without what signals, each (n,), do in amounts of about one.

    An amount is as likely as a normal variate: one that is needed a thousandfold explains nothing.
    """
    if not signals:
        return gap
    return np.asarray(gap - np.stack(signals, axis=1) @ _amounts(signals, gap))


def _amounts(signals: Sequence[FloatArray], gap: FloatArray) -> FloatArray:
    """Return the most likely amounts (m,) of m signals, each (n,), in a gap (n,)."""
    # Stacked on what is known of the amounts, and not squared: signals may be far larger than one
    # and parallel.
    known = np.vstack([np.stack(signals, axis=1), np.eye(len(signals))])
    q, r = np.linalg.qr(known)
    return np.asarray(np.linalg.solve(r, q[: len(gap)].T @ gap))


def within_a_row(
    gap: FloatArray, answer: FloatArray, own: Callable[[FloatArray], FloatArray]
) -> FloatArray:
    """Return the gap (n,) of an amplifier's output that is read up to a row earlier or later.

    A command makes the output leap as a row begins, and whether a recorder reads it just before,
    just after or on the way tells nothing of the machine. ``answer`` (n,) is the model's output;
    ``own`` takes what is the record's own out of a signal. All in floors.
    """
    read = [gap]
    for moved in (np.diff(answer, append=answer[-1:]), -np.diff(answer, prepend=answer[:1])):
        one = own(moved)
        size = float(one @ one)
        if size > 0.0:
            read.append(gap - min(max(float(one @ gap) / size, 0.0), 1.0) * one)
    return min(read, key=lambda left: float(left @ left))


def _own_signals(
    observation: Observation, kept: BoolArray | None, weight: FloatArray | None, rows: int
) -> FloatArray:
    """Return an orthonormal basis (n, m) of a record's nuisances over the rows that are kept."""
    signals = [np.ones((rows, 1))]
    if observation.nuisance is not None:
        signals.append(observation.nuisance)
    together = np.hstack(signals)
    if kept is not None:
        together = together * kept[:, None]
    if weight is not None:
        together = together * weight[:, None]
    return np.asarray(np.linalg.qr(together)[0])


def _centred(signal: FloatArray) -> FloatArray:
    return np.asarray(signal - signal.mean())
