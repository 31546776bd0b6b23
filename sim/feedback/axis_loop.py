"""One axis under a controller, simulated with its robot file and effects.

The plant is that of the simulation (:mod:`rotemina.sim.plant`), stepped from sample to sample as in
live operation. The controller runs the same code as in live operation.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import FeedbackError
from rotemina.sim.feedback import loop_kernel
from rotemina.sim.feedback.controller import make_controller_parameters, make_rest_memory
from rotemina.sim.feedback.feed_forward import FeedForward
from rotemina.sim.feedback.gains import ControllerGains, OutputLimits
from rotemina.sim.feedback.sampled_axis import SampledAxis, count_late_intervals
from rotemina.sim.plant import (
    ChainPoint,
    Plant,
    PlantState,
    PlantTables,
    RandomStreams,
    compute_position_gain,
    cut_run,
    kernel,
    make_steps,
    make_ticks,
)
from rotemina.sim.robot import ForceAxis, Robot

# Faster loops around a motor or a piezo do not exist.
MAX_LOOP_RATE_HZ = 1e6
_MAX_DELAY_INTERVALS = 1000
# Iterations of the search for the command that holds an axis at a position.
_MAX_REST_ITERATIONS = 60
# The search ends when the deviation from that position is within this share of the range.
_REST_TOLERANCE_SHARE = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class LoopTraces:
    """Signals of a simulated loop, each (n,), m or rad.

    Attributes
    ----------
    reference : requested position.
    output : output of the controller, held from each sample to the next.
    position : true position of the axis.
    reading : reading of the sensor, without its offset.
    limited_count : number of samples at which a limit cut off the output.
    """

    time_s: FloatArray
    reference: FloatArray
    output: FloatArray
    position: FloatArray
    reading: FloatArray
    limited_count: int


class AxisLoop:
    """The loop around one axis; the other axes of its group are held in mid-range.

    Parameters
    ----------
    robot : Robot
        With its effects.
    axis : str
    rate_hz : float
        Sampling rate of the loop.
    delay : int
        Intervals by which the output is delayed, in addition to the delay of the effects.
    gain : float
        Ratio of the actuator's gain to its nominal gain.

    Raises
    ------
    FeedbackError
        If this loop cannot be closed around the axis.
    EffectError
        If an effect cannot be used.
    """

    def __init__(
        self, robot: Robot, axis: str, rate_hz: float, *, delay: int = 0, gain: float = 1.0
    ) -> None:
        _check_settings(robot, axis, rate_hz, delay)
        self.axis = axis
        self.interval_s = 1.0 / rate_hz
        self.plant = Plant.of(robot, only=[axis])
        self.robot_axis = self.plant.robot.axes[axis]
        self._column = self.plant.axes.index(axis)
        self._extra_delay, self._gain = delay, gain
        self._total_delay = delay + count_late_intervals(self.plant, axis, self.interval_s)
        self._rests: dict[float, tuple[float, PlantState]] = {}

    @cached_property
    def sampled_axis(self) -> SampledAxis:
        """The axis as a linear system, for the analysis of stability."""
        sampled_axis = SampledAxis.of(
            self.plant, self.axis, self.interval_s, delay=self._extra_delay
        )
        return sampled_axis.with_gain(self._gain)

    @cached_property
    def limits(self) -> OutputLimits:
        """Permitted outputs: the range of the axis, or the range that its voltages reach."""
        low, high = self.robot_axis.range
        voltages = self.robot_axis.voltage_range
        if voltages is not None:
            position_per_volt = compute_position_gain(self.robot_axis)
            low, high = sorted(position_per_volt * voltage for voltage in voltages)
        return OutputLimits(low, high)

    def follow(
        self,
        gains: ControllerGains,
        reference: FloatArray,
        *,
        feed_forward: FeedForward | None = None,
        feed: FloatArray | None = None,
        rng: np.random.Generator | None = None,
    ) -> LoopTraces:
        """Simulate how the axis follows a reference (n,), from rest at its first position.

        ``feed`` (n,) is the output of ``feed_forward`` for the reference, if it has been computed
        already. With ``rng``, noise, rounding and random effects are simulated.
        """
        if feed is None:
            feed = (feed_forward or FeedForward()).run(reference)
        numbers = make_controller_parameters(gains, self.interval_s, self.limits)
        start = float(reference[0])
        # Repeated simulations start at the same few positions, so the states of rest are cached.
        if start not in self._rests:
            self._rests[start] = self._find_rest(start)
        held_output, state = self._rests[start]
        memory = make_rest_memory(numbers, float(feed[0]), held_output)
        rows = self._make_run_arrays(state, len(reference))
        kernel_state = kernel.KernelState(
            state.x.copy(), state.memory.copy(), state.called_s.copy()
        )
        variates = np.zeros((0, len(self.plant.axes)))
        if rng is not None:
            axis_count, variate_count = len(self.plant.axes), self.plant.assembly.variate_count
            variates = RandomStreams(rng).draw(len(reference), axis_count, variate_count)
        output = np.empty((len(reference), 1))
        loops = loop_kernel.LoopArrays(
            np.array([self._column], dtype=np.int64),
            np.array([self._input_per_output]),
            np.array([self.robot_axis.offset]),
            np.array([self._total_delay], dtype=np.int64),
            numbers[None],
            memory[None],
        )
        limited_count = loop_kernel.follow(
            self._tables, self._steps, kernel_state, rows, rows.inputs[1:], variates, loops,
            np.ascontiguousarray(reference)[:, None], np.ascontiguousarray(feed)[:, None], output,
        )  # fmt: skip
        return LoopTraces(
            np.asarray(self.interval_s * np.arange(len(reference)), dtype=np.float64),
            reference,
            output[:, 0].copy(),
            rows.position[1:, self._column].copy(),
            np.asarray(rows.reading[1:, self._column] - self.robot_axis.offset),
            int(limited_count),
        )

    @property
    def _input_per_output(self) -> float:
        return self._gain / compute_position_gain(self.robot_axis)

    def _make_run_arrays(self, state: PlantState, samples: int) -> loop_kernel.RunArrays:
        """Allocate the arrays of a run; their first row is the state of rest before it."""
        time_s = self.interval_s * np.arange(samples + 1.0)
        axes = len(self.plant.axes)
        inputs = np.tile(state.inputs[-1], (samples + 1, 1))
        return make_run_arrays(state, time_s, inputs, np.zeros((0, axes)))

    @cached_property
    def _tables(self) -> PlantTables:
        """Tables of the plant without delays, because the loop applies them itself."""
        tables = self.plant.make_tables(ChainPoint.COMMAND)
        table = tables.axis.copy()
        table["late"] = 0
        return tables._replace(axis=table)

    @cached_property
    def _steps(self) -> kernel.KernelSteps:
        return make_steps(
            cut_run(make_ticks(np.array([0.0, self.interval_s]), 1), 1, (0.0,)),
            self.plant.assembly.all_groups,
            inner_step_s=self.plant.assembly.inner_step_s,
            with_holds=bool(self.plant.effects),
        )

    def _find_rest(self, position: float) -> tuple[float, PlantState]:
        """Return the output that holds the axis at ``position``, and the state of rest there.

        The axis has been at rest for a long time, after a rise from the low end. The output is
        found by the secant method, because the position increases with the output, also with
        effects.
        """
        span = self.robot_axis.span
        output, previous = position, None
        state = self._compute_rest_state(output)
        for _ in range(_MAX_REST_ITERATIONS):
            deviation = float(state.position[-1, self._column]) - position
            if abs(deviation) <= _REST_TOLERANCE_SHARE * span:
                break
            slope = 1.0
            if previous is not None and output != previous[0] and deviation != previous[1]:
                slope = (deviation - previous[1]) / (output - previous[0])
            previous = output, deviation
            output -= deviation / min(max(slope, 0.2), 5.0)
            state = self._compute_rest_state(output)
        return output, state

    def _compute_rest_state(self, output: float) -> PlantState:
        command = np.array([sum(axis.range) / 2.0 for axis in self.plant.robot.axes.values()])
        command[self._column] = self._gain * output
        return self.plant.find_rest_state(0.0, command)


def make_run_arrays(
    state: PlantState, time_s: FloatArray, inputs: FloatArray, effort: FloatArray
) -> loop_kernel.RunArrays:
    """Allocate the arrays of a run at ``time_s`` (n + 1,), whose first row is ``state``."""
    arrays = [np.zeros(inputs.shape) for _ in range(3)]
    for array, row in zip(arrays, (state.position, state.velocity, state.reading), strict=True):
        array[0] = row[-1]
    return loop_kernel.RunArrays(time_s, inputs, effort, *arrays)


def _check_settings(robot: Robot, axis: str, rate_hz: float, delay: int) -> None:
    if axis not in robot.axes:
        raise FeedbackError(
            "axis {axis}: robot {name} has no such axis; use one of {names}",
            axis=repr(axis),
            name=repr(robot.name),
            names=", ".join(robot.axes),
        )
    if isinstance(robot.axes[axis], ForceAxis):
        raise FeedbackError(
            "axis {axis}: a force moves this axis, so it holds no position; give it a "
            "cascade controller in the robot file",
            axis=axis,
        )
    if not 0.0 < rate_hz <= MAX_LOOP_RATE_HZ:
        raise FeedbackError(
            "loop rate {rate_hz} Hz: must be more than 0, at most {fastest_hz} Hz",
            rate_hz=rate_hz,
            fastest_hz=MAX_LOOP_RATE_HZ,
        )
    if not 0 <= delay <= _MAX_DELAY_INTERVALS:
        raise FeedbackError(
            "loop delay of {delay} intervals: must be 0 to {longest_delay}",
            delay=delay,
            longest_delay=_MAX_DELAY_INTERVALS,
        )
