"""The simulated machine. It runs in device time, without host clock or threads."""

from dataclasses import replace
from enum import Enum, auto

import numpy as np

from rotemina.drivers.contract import DeviceSamples
from rotemina.drivers.simulator.axis_inverses import InverseAtRest, SetpointInverses
from rotemina.drivers.simulator.axis_loops import ClosedLoops
from rotemina.drivers.simulator.homing import HomingState
from rotemina.drivers.simulator.profile_motion import ProfileMotion
from rotemina.drivers.simulator.setpoint_generator import SetpointGenerator
from rotemina.drivers.simulator.trajectory_playback import (
    CommandChunk,
    TrajectoryPlayback,
    select_samples,
)
from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate import InverseExceedance, InverseModel
from rotemina.sim.errors import CompensationError
from rotemina.sim.feedback import AxisRegulation
from rotemina.sim.plant import Plant, PlantState, RandomStreams, transfer_state
from rotemina.sim.records import Record
from rotemina.sim.robot import (
    AxisEffect,
    Robot,
    StepperAxis,
)
from rotemina.sim.trajectory import SetpointLimits

# Number of the random stream for the noise of the reference.
_LASER_STREAM = 7
# Largest number of samples simulated at once, which limits the memory without affecting the result.
_CHUNK_SAMPLES = 8192


class _Phase(Enum):
    # Holding, or moving to the targets of single moves.
    HOLD = auto()
    # Moving to the first row of a trajectory.
    APPROACH = auto()
    # Waiting at the first row until vibrations have decayed.
    SETTLE = auto()
    ROWS = auto()
    PROFILE = auto()


class SimulatedDevice:
    """The simulated machine: a plant with effects and sensors, set-points and playback.

    Parameters
    ----------
    robot : Robot
    tick_s : float
        Interval between samples, and between set-points of single moves. While an axis is in a
        closed loop, all set-points are computed at the finer ticks of the loop.
    seed : int
        Seed of noise and random effects. Each playback starts a new random sequence, so that it
        does not depend on the idle time before it.
    settle_s : float
        Time of rest at the first row of a trajectory.
    position : (axes,)
        Initial position, m or rad, within the range.
    time_s : float
        Device time of the first sample.
    homing : HomingState, optional
        State of the homing; if it is None, all positions are known.
    """

    def __init__(
        self,
        robot: Robot,
        *,
        tick_s: float,
        seed: int,
        settle_s: float,
        position: FloatArray,
        time_s: float = 0.0,
        homing: HomingState | None = None,
    ) -> None:
        self._robot = robot
        self._homing = homing if homing is not None else HomingState(())
        self._profile: ProfileMotion | None = None
        self._plant = Plant.of(robot, closed_loop=True)
        # The time of the plant restarts at each sample, so that rounding errors do not grow.
        self._state = self._plant.find_rest_state(0.0, position)
        axes = robot.axes.values()
        self._has_voltage = np.array([not isinstance(axis, StepperAxis) for axis in axes])
        self._setpoints = SetpointGenerator(SetpointLimits.of(robot), tick_s, position)
        self._inverses = SetpointInverses(SetpointLimits.of(robot), tick_s)
        self._loops = ClosedLoops(tick_s)
        # Bound on the change of a loop's output while the loop holds a stopped axis.
        self._hold_bounds = np.array([axis.following_limit for axis in axes])
        self._command = np.array(position, dtype=np.float64)
        self._actuator_command = self._command
        self._tick_s = tick_s
        self._seed = seed
        self._settle_s = settle_s
        self._random_streams = RandomStreams(np.random.default_rng(seed))
        # The reference has its own random stream, so that it does not change the sensors' noise.
        self._laser_rng = np.random.default_rng([seed, _LASER_STREAM])
        noise_rms = robot.reference.noise_rms
        self._laser_noise_rms = np.array([noise_rms.of(axis.unit) or 0.0 for axis in axes])
        self._phase = _Phase.HOLD
        self._playback: TrajectoryPlayback | None = None
        self._settled_ticks = 0
        self._playback_count = 0
        # Ticks are counted from an anchor, because adding up intervals would accumulate rounding
        # errors.
        self._anchor_s = time_s
        self._tick_count = -1

    @property
    def time_s(self) -> float:
        """Device time of the latest sample; initially one tick before the first sample."""
        if self._phase is _Phase.ROWS and self._playback is not None and self._playback.has_begun:
            return self._playback.time_s
        return self._anchor_s + self._tick_count * self._tick_s

    @property
    def command(self) -> FloatArray:
        """Latest desired set-points (axes,), m or rad, also during playback."""
        return self._command.copy()

    @property
    def actuator_command(self) -> FloatArray:
        """Latest commands to the actuators (axes,), m or rad."""
        return self._actuator_command.copy()

    @property
    def exceedances(self) -> dict[int, InverseExceedance]:
        """How far each axis has exceeded the range of its inverse, by axis number."""
        return self._inverses.exceedances

    @property
    def regulations(self) -> dict[int, AxisRegulation]:
        """Closed loops, by axis number. Any thread may read them."""
        return dict(self._loops.regulations)

    @property
    def limited_axes(self) -> tuple[int, ...]:
        """Numbers of the axes whose loop output is limited now."""
        return tuple(index for index in self.regulations if self._loops.is_limited(index))

    @property
    def tick_s(self) -> float:
        """Current interval between set-points."""
        return self._tick_s

    @property
    def true_position(self) -> FloatArray:
        """True positions (axes,), m or rad, with all effects but without sensor errors."""
        return np.asarray(self._state.position[-1])

    @property
    def is_moving(self) -> bool:
        """Whether a single move, or the braking after a stop, is running."""
        return self._setpoints.moving

    @property
    def is_playing(self) -> bool:
        """Whether a profile or a trajectory, including its approach, is running."""
        return self._phase is not _Phase.HOLD

    @property
    def running_profile(self) -> bool:
        """Whether a profile is running."""
        return self._phase is _Phase.PROFILE

    @property
    def progress(self) -> float:
        """Fraction of the current or latest trajectory or profile that has been played, 0 to 1."""
        if self._profile is not None:
            return self._profile.progress
        return self._playback.progress if self._playback is not None else 0.0

    def make_plant_with_effects(self, effects: tuple[AxisEffect, ...]) -> tuple[Plant, PlantState]:
        """Return a plant with other effects, and its state at the current position and speed."""
        plant = Plant.of(replace(self._robot, effects=effects), closed_loop=True)
        return plant, transfer_state(plant, self._plant, self._state)

    def set_plant(self, plant: Plant, state: PlantState) -> None:
        """Continue with another plant in a given state."""
        self._plant, self._state = plant, state

    def find_rest(self, index: int, model: InverseModel | None) -> InverseAtRest:
        """Return the inverse of an axis at rest, if there is one. The call changes nothing.

        Raises
        ------
        CompensationError
            If the axis is out of the range of the inverse.
        """
        if index in self._loops.regulations:
            # The inverse is part of the feed-forward of the loop.
            return InverseAtRest(None, float(self._actuator_command[index]))
        return self._inverses.find_rest(model, float(self._actuator_command[index]))

    def compensate(self, index: int, model: InverseModel | None, rest: InverseAtRest) -> None:
        """Apply an inverse to the axis with this number, or remove it. The axis must be at rest.

        Raises
        ------
        CompensationError
            If the axis is in a loop, and out of the range of the inverse for its feed-forward.
        """
        loop = self._loops.regulations.get(index)
        if loop is None:
            command = self._inverses.replace_inverse(index, model, rest)
        else:
            command = self._inverses.lend_to_loop(index, model, float(self._command[index]))
            self._loops.close_loop(index, loop, model, command, rest.command)
        self._set_rest_command(index, command)

    def regulate(self, index: int, regulation: AxisRegulation | None) -> None:
        """Close a loop around the axis with this number, or open it. The machine must be at rest.

        The axis does not jump. A loop starts at the measured position, with the current actuator
        command as its output. The output is kept when the loop is opened. An inverse in use becomes
        part of the feed-forward of the loop, and is used directly again when the loop is opened. If
        the inverse cannot produce the output of the loop, it is removed with the loop.

        Raises
        ------
        FeedbackError, CompensationError
            If the rate of the loop does not fit, or the axis is outside the range of its inverse.
        """
        actuator_command, model = (
            float(self._actuator_command[index]),
            self._inverses.get_model(index),
        )
        if regulation is not None:
            self._loops.check_loop(index, regulation, has_no_controllers=not any(self._plant.loops))
            offset = list(self._robot.axes.values())[index].offset
            command = float(self._state.reading[-1, index]) - offset
            command = self._inverses.lend_to_loop(index, model, command)
            self._loops.close_loop(index, regulation, model, command, actuator_command)
            self._update_tick()
        else:
            self._loops.open_loop(index)
            self._update_tick()
            try:
                rest = self._inverses.find_rest(model, actuator_command)
            except CompensationError:
                model, rest = None, InverseAtRest(None, actuator_command)
            command = self._inverses.replace_inverse(index, model, rest)
        self._set_rest_command(index, command)

    def _set_rest_command(self, index: int, command: float) -> None:
        self._setpoints.set_bounds(index, *self._inverses.find_bounds(index))
        self._command[index] = command
        self._setpoints.take_over(self._command, np.zeros(len(self._command)))

    def _update_tick(self) -> None:
        tick_s = self._loops.tick_s
        if tick_s != self._tick_s:
            self._anchor_s, self._tick_count, self._tick_s = self.time_s, 0, tick_s
            self._setpoints.set_tick(tick_s)
            self._inverses.set_tick(tick_s)

    def move_to(self, index: int, target: float, max_speed: float | None = None) -> None:
        """Move the axis with this number to a target, no faster than ``max_speed``."""
        self._loops.release_hold(index)
        self._setpoints.retarget({index: target}, max_speed)

    def drive(self, index: int, velocity: float) -> None:
        """Move the axis with this number at a speed, m/s or rad/s; a speed of 0 brakes it."""
        if velocity:
            self._loops.release_hold(index)
        self._setpoints.drive(index, velocity)

    def prepare_playback(self, trajectory: Record) -> TrajectoryPlayback:
        """Return the playback of a trajectory in the current configuration; changes nothing."""
        # Loops and inverses run only at ticks.
        on_ticks = any(self._plant.loops) or bool(self._inverses.exceedances or self._loops)
        return TrajectoryPlayback(
            trajectory,
            self._plant.axes,
            self._tick_s,
            self._loops.ticks_per_sample,
            on_ticks=on_ticks,
            smooth=bool(self._loops),
        )

    def play(self, playback: TrajectoryPlayback) -> None:
        """Start a playback: approach the first row, settle, then play the rows."""
        self._profile = None
        self._loops.release_hold()
        self._playback = playback
        self._settled_ticks = 0
        self._setpoints.retarget(playback.first_commands)
        self._phase = _Phase.APPROACH

    def run_profile(self, profile: ProfileMotion) -> None:
        """Run a profile from the next tick on. All axes must be at rest."""
        self._loops.release_hold(profile.index)
        self._profile = profile
        self._phase = _Phase.PROFILE

    def home(self, axes: tuple[int, ...]) -> None:
        """Move the axes with these numbers to their switches. The axes must be at rest."""
        self._homing.begin(axes, self._setpoints)

    def stop(self) -> None:
        """End any motion, and brake with the maximum acceleration of the axes."""
        self._homing.abort()
        if self._phase is _Phase.PROFILE and self._profile is not None:
            self._end_profile(self._profile)
        if self._phase is _Phase.ROWS and self._playback is not None and self._playback.has_begun:
            self._end_rows(self._command, self._playback)
        self._setpoints.stop()
        self._loops.hold_outputs(self._hold_bounds)
        self._phase = _Phase.HOLD

    def advance(self, until_s: float) -> list[DeviceSamples]:
        """Simulate up to the last sample that is not after ``until_s``, and return the samples.

        Raises
        ------
        PlantError
            If the response diverges.
        """
        parts: list[DeviceSamples] = []
        while True:
            chunk = self._take_next_chunk(until_s)
            if not len(chunk.time_s):
                return parts
            if len(samples := self._sample(chunk)):
                parts.append(samples)

    def _take_next_chunk(self, until_s: float) -> CommandChunk:
        if self._phase is _Phase.ROWS and self._playback is not None:
            return self._take_row_chunk(self._playback, until_s)
        elapsed_ticks = (until_s - self._anchor_s) / self._tick_s
        ticks = max(min(int(np.floor(elapsed_ticks + 1e-6)) - self._tick_count, _CHUNK_SAMPLES), 0)
        if self._phase is _Phase.PROFILE and self._profile is not None:
            return self._take_profile_chunk(self._profile, ticks)
        return self._take_tick_chunk(ticks)

    def _take_profile_chunk(self, profile: ProfileMotion, ticks: int) -> CommandChunk:
        """Return at most ``ticks`` ticks of a profile. The other axes hold."""
        path = profile.advance(ticks)
        command = np.tile(self._setpoints.position, (len(path), 1))
        command[:, profile.index] = path
        if len(path):
            self._command = command[-1].copy()
        chunk = self._make_chunk(command)
        if profile.has_ended:
            self._end_profile(profile)
        return chunk

    def _end_profile(self, profile: ProfileMotion) -> None:
        """Brake from the latest command of a profile and its speed, and hold."""
        velocity = np.zeros(len(self._plant.axes))
        if profile.elapsed_ticks:
            velocity[profile.index] = profile.compute_velocity()
        self._setpoints.take_over(self._command, velocity)
        self._phase = _Phase.HOLD

    def _take_tick_chunk(self, ticks: int) -> CommandChunk:
        """Return at most ``ticks`` ticks; a chunk ends when a phase ends."""
        if self._phase is _Phase.SETTLE:
            ticks = min(ticks, self._settle_ticks - self._settled_ticks)
        is_approach = self._phase is _Phase.APPROACH
        command = self._setpoints.generate(ticks, until_rest=is_approach)
        self._homing.note_arrival(self._setpoints)
        chunk = self._make_chunk(command)
        if is_approach and len(command) and not self._setpoints.moving:
            self._phase = _Phase.SETTLE
        elif self._phase is _Phase.SETTLE:
            self._settled_ticks += len(command)
        if self._phase is _Phase.SETTLE and self._settled_ticks >= self._settle_ticks:
            self._begin_rows(self._playback)
        return chunk

    @property
    def _settle_ticks(self) -> int:
        return round(self._settle_s / self._tick_s)

    def _make_chunk(self, command: FloatArray) -> CommandChunk:
        """Count the ticks of commands (n, axes), and return the commands with their times."""
        tick_numbers = np.arange(
            self._tick_count + 1, self._tick_count + 1 + len(command), dtype=np.int64
        )
        elapsed_ticks = tick_numbers - max(self._tick_count, 0)
        self._tick_count += len(command)
        return CommandChunk(
            (self._anchor_s + tick_numbers * self._tick_s).astype(np.float64),
            (elapsed_ticks * self._tick_s).astype(np.float64),
            command,
            np.full(len(command), -1, dtype=np.int64),
            tick_numbers % self._loops.ticks_per_sample == 0,
        )

    def _begin_rows(self, playback: TrajectoryPlayback | None) -> None:
        assert playback is not None, "a trajectory was approached"
        playback.begin(self._anchor_s + (self._tick_count + 1) * self._tick_s)
        self._phase = _Phase.ROWS
        self._playback_count += 1

    def _take_row_chunk(self, playback: TrajectoryPlayback, until_s: float) -> CommandChunk:
        if not playback.has_begun:
            self._random_streams = RandomStreams(
                np.random.default_rng([self._seed, self._playback_count])
            )
        chunk = playback.take_chunk(until_s, self._setpoints.position, _CHUNK_SAMPLES)
        if playback.has_ended and len(chunk.time_s):
            self._end_rows(chunk.command[-1], None)
        return chunk

    def _end_rows(self, command: FloatArray, playback: TrajectoryPlayback | None) -> None:
        """Brake from the latest set-points (axes,) and the speed of ``playback``, and hold."""
        velocity = np.zeros(len(command)) if playback is None else playback.compute_velocity()
        self._anchor_s, self._tick_count = self.time_s, 0
        self._setpoints.take_over(command, velocity)
        self._phase = _Phase.HOLD

    def _sample(self, chunk: CommandChunk) -> DeviceSamples:
        motion, state, actuator_command = self._loops.advance(
            self._plant,
            self._state,
            chunk.elapsed_s,
            chunk.command,
            self._inverses.compute_actuator_commands(chunk.command),
            self._random_streams,
        )
        self._inverses.note_exceedances(self._loops.exceedances)
        self._state = replace(state, time_s=state.time_s - state.time_s[-1])
        self._command, self._actuator_command = (
            chunk.command[-1].copy(),
            actuator_command[-1].copy(),
        )
        inputs = np.where(self._has_voltage, motion.inputs, np.nan)
        noise = self._laser_noise_rms * self._laser_rng.standard_normal(motion.position.shape)
        reference = motion.position + noise
        samples = DeviceSamples(
            chunk.time_s, chunk.command, motion.reading, inputs, chunk.row, reference
        )
        return select_samples(samples, chunk.is_sample)
