"""One axis under a controller, simulated with its robot file and effects.

The plant is the engine's own (:mod:`rotemina.sim.plant`), stepped from sample to sample as a live
one is; the controller is the one that runs live.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.feedback import loop_kernel
from rotemina.sim.feedback.controller import numbers_of, rested
from rotemina.sim.feedback.errors import FeedbackError
from rotemina.sim.feedback.feed_forward import FeedForward
from rotemina.sim.feedback.gains import Gains, OutputLimits
from rotemina.sim.feedback.sampled_axis import SampledAxis, late_intervals
from rotemina.sim.messages import message
from rotemina.sim.plant import kernel
from rotemina.sim.plant.coupled_groups import asked_position
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.plant_arrays import Machine
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.plant.segment_steps import steps_through
from rotemina.sim.plant.state import Behind, PlantState
from rotemina.sim.plant.zero_order_hold import cut, ticks_of
from rotemina.sim.robot.model import ForceAxis, Robot

FASTEST_HZ = 1e6  # rate of a loop: beyond that nobody closes one about a motor or a piezo
_LONGEST_DELAY = 1000  # intervals
_TRIES = 60  # of the command that holds an axis at a position
_NEAR = 1e-12  # share of the range within which it is held there


@dataclass(frozen=True, slots=True, eq=False)
class Traces:
    """What happened, each (n,), m or rad.

    ``output`` is what the controller asked for from its sample on, ``position`` the true one,
    ``reading`` what the sensor said (offset taken off); ``limited`` counts the samples at which a
    limit cut the output off.
    """

    time_s: FloatArray
    reference: FloatArray
    output: FloatArray
    position: FloatArray
    reading: FloatArray
    limited: int


class AxisLoop:
    """The loop around one axis; the others of its group are held in mid-range.

    Parameters
    ----------
    robot : Robot
        With its effects.
    axis : str
    rate_hz : float
        Of the loop.
    delay : int
        Intervals by which an output acts late, beside the effects' own.
    gain : float
        Share of its nominal gain that the actuator has.

    Raises
    ------
    FeedbackError
        If the axis cannot be put under this loop.
    EffectError
        If an effect cannot be used.
    """

    def __init__(
        self, robot: Robot, axis: str, rate_hz: float, *, delay: int = 0, gain: float = 1.0
    ) -> None:
        _check(robot, axis, rate_hz, delay)
        self.axis = axis
        self.interval_s = 1.0 / rate_hz
        self.plant = Plant.of(robot, only=[axis])
        self.robot_axis = self.plant.robot.axes[axis]
        self._column = self.plant.axes.index(axis)
        self._extra, self._gain = delay, gain
        self._late = delay + late_intervals(self.plant, axis, self.interval_s)
        self._rests: dict[float, tuple[float, PlantState]] = {}

    @cached_property
    def sampled(self) -> SampledAxis:
        """The axis as a linear system, for the analysis of stability."""
        own = SampledAxis.of(self.plant, self.axis, self.interval_s, delay=self._extra)
        return own.scaled(self._gain)

    @cached_property
    def limits(self) -> OutputLimits:
        """What may be asked of the axis: its range, or what its voltages reach."""
        low, high = self.robot_axis.range
        voltages = self.robot_axis.voltage_range
        if voltages is not None:
            asked = asked_position(self.robot_axis)
            low, high = sorted(asked * voltage for voltage in voltages)
        return OutputLimits(low, high)

    def follow(
        self,
        gains: Gains,
        reference: FloatArray,
        *,
        feed_forward: FeedForward | None = None,
        feed: FloatArray | None = None,
        rng: np.random.Generator | None = None,
    ) -> Traces:
        """Return how the axis follows a reference (n,), from rest at its first position.

        ``feed`` (n,) is what ``feed_forward`` makes of the reference, if it is known already;
        ``rng`` gives noise, rounding and random effects.
        """
        if feed is None:
            feed = (feed_forward or FeedForward()).run(reference)
        numbers = numbers_of(gains, self.interval_s, self.limits)
        start = float(reference[0])
        if start not in self._rests:  # a search begins at the same places again and again
            self._rests[start] = self._held(start)
        held, state = self._rests[start]
        memory = rested(numbers, float(feed[0]), held)
        rows = self._rows(state, len(reference))
        moving = kernel.State(state.x.copy(), state.memory.copy(), state.seen.copy())
        drawn = np.zeros((0, len(self.plant.axes)))
        if rng is not None:
            axes, random = len(self.plant.axes), self.plant.assembly.random
            drawn = Chance(rng).draw(len(reference), axes, random)
        output = np.empty((len(reference), 1))
        loops = loop_kernel.Loops(
            np.array([self._column], dtype=np.int64),
            np.array([self._per_asked]),
            np.array([self.robot_axis.offset]),
            np.array([self._late], dtype=np.int64),
            numbers[None],
            memory[None],
        )
        limited = loop_kernel.follow(
            self._machine, self._steps, moving, rows, rows.inputs[1:], drawn, loops,
            np.ascontiguousarray(reference)[:, None], np.ascontiguousarray(feed)[:, None], output,
        )  # fmt: skip
        return Traces(
            np.asarray(self.interval_s * np.arange(len(reference)), dtype=np.float64),
            reference,
            output[:, 0].copy(),
            rows.position[1:, self._column].copy(),
            np.asarray(rows.reading[1:, self._column] - self.robot_axis.offset),
            int(limited),
        )

    @property
    def _per_asked(self) -> float:
        return self._gain / asked_position(self.robot_axis)

    def _rows(self, state: PlantState, samples: int) -> loop_kernel.Rows:
        """Make room for a run; its first row is the rest before it."""
        time_s = self.interval_s * np.arange(samples + 1.0)
        axes = len(self.plant.axes)
        inputs = np.tile(state.inputs[-1], (samples + 1, 1))
        return rows_after(state, time_s, inputs, np.zeros((0, axes)))

    @cached_property
    def _machine(self) -> Machine:
        """The plant's tables; the loop brings delays along itself."""
        machine = self.plant.machine(Behind.COMMAND)
        table = machine.axis.copy()
        table["late"] = 0
        return machine._replace(axis=table)

    @cached_property
    def _steps(self) -> kernel.Steps:
        return steps_through(
            cut(ticks_of(np.array([0.0, self.interval_s]), 1), 1, (0.0,)),
            self.plant.assembly.all_groups,
            inner_step_s=self.plant.assembly.inner_step_s,
            with_holds=bool(self.plant.effects),
        )

    def _held(self, position: float) -> tuple[float, PlantState]:
        """Return what to ask for so that the axis rests at ``position``, and the state then.

        After a rise from the low end, long ago; found by the secant rule, as what effects make of
        a command grows with it.
        """
        span = self.robot_axis.span
        asked, last = position, None
        state = self._at_rest(asked)
        for _ in range(_TRIES):
            off = float(state.position[-1, self._column]) - position
            if abs(off) <= _NEAR * span:
                break
            slope = 1.0
            if last is not None and asked != last[0] and off != last[1]:
                slope = (off - last[1]) / (asked - last[0])
            last = asked, off
            asked -= off / min(max(slope, 0.2), 5.0)
            state = self._at_rest(asked)
        return asked, state

    def _at_rest(self, asked: float) -> PlantState:
        command = np.array([sum(one.range) / 2.0 for one in self.plant.robot.axes.values()])
        command[self._column] = self._gain * asked
        return self.plant.at_rest(0.0, command)


def rows_after(
    state: PlantState, time_s: FloatArray, inputs: FloatArray, effort: FloatArray
) -> loop_kernel.Rows:
    """Make room for a run at ``time_s`` (n + 1,) whose first row is where a plant stands."""
    filled = [np.zeros(inputs.shape) for _ in range(3)]
    for whole, row in zip(filled, (state.position, state.velocity, state.reading), strict=True):
        whole[0] = row[-1]
    return loop_kernel.Rows(time_s, inputs, effort, *filled)


def _check(robot: Robot, axis: str, rate_hz: float, delay: int) -> None:
    if axis not in robot.axes:
        raise FeedbackError(
            message(
                "engine", "axis {axis}: robot {name} has no such axis; use one of {names}"
            ).fill(axis=repr(axis), name=repr(robot.name), names=", ".join(robot.axes))
        )
    if isinstance(robot.axes[axis], ForceAxis):
        raise FeedbackError(
            message(
                "engine",
                "axis {axis}: a force moves this axis, so it holds no position; give it a "
                "cascade controller in the robot file",
            ).fill(axis=axis)
        )
    if not 0.0 < rate_hz <= FASTEST_HZ:
        raise FeedbackError(
            message(
                "engine", "loop rate {rate_hz} Hz: must be more than 0, at most {fastest_hz} Hz"
            ).fill(rate_hz=rate_hz, fastest_hz=FASTEST_HZ)
        )
    if not 0 <= delay <= _LONGEST_DELAY:
        raise FeedbackError(
            message("engine", "loop delay of {delay} intervals: must be 0 to {longest_delay}").fill(
                delay=delay, longest_delay=_LONGEST_DELAY
            )
        )
