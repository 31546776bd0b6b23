"""The simulated machine, in device time, independent of hosts and threads."""

from dataclasses import replace
from enum import Enum, auto

import numpy as np

from rotemina.drivers.samples import Samples
from rotemina.drivers.simulator.axis_inverses import Compensating, Rest
from rotemina.drivers.simulator.axis_loops import Regulating
from rotemina.drivers.simulator.homing import Homing
from rotemina.drivers.simulator.profile_motion import ProfileMotion
from rotemina.drivers.simulator.setpoint_generator import SetpointGenerator
from rotemina.drivers.simulator.trajectory_playback import Chunk, Playing, selected
from rotemina.sim.arrays import FloatArray
from rotemina.sim.compensate.errors import CompensationError
from rotemina.sim.compensate.inverse import Exceedance
from rotemina.sim.compensate.inverse_parameters import InverseModel
from rotemina.sim.feedback.regulation import Regulation
from rotemina.sim.plant.effect_switch import taken_over
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.random_draws import Chance
from rotemina.sim.plant.state import PlantState
from rotemina.sim.records.record import Record
from rotemina.sim.robot.model import AxisEffect, Robot, StepperAxis
from rotemina.sim.trajectory.setpoint_limits import SetpointLimits

_LASER = 7  # the stream of its noise
_CHUNK = 8192  # samples simulated at once: bounds memory, not the result


class _Phase(Enum):
    HOLD = auto()  # holding, or on the way to the targets of single moves
    APPROACH = auto()  # on the way to the first row of a trajectory
    SETTLE = auto()  # waiting there for the vibration to die away
    ROWS = auto()  # playing
    PROFILE = auto()  # running a profile


class SimulatedDevice:
    """The plant with its effects and sensors, a set-point generator and a player.

    Parameters
    ----------
    robot : Robot
    tick_s : float
        Interval between samples, and between set-points of single moves. While an axis is under a
        loop, set-points come at the loop's ticks, and so fine a trajectory is followed.
    seed : int
        Of noise and random effects. Each playback starts a sequence of its own, so that it does not
        depend on how long the device idled before.
    settle_s : float
        How long to wait at a trajectory's first row.
    position : (axes,)
        Where the machine stands at first, m or rad, inside the range.
    time_s : float
        Device time of the first sample.
    homing : Homing, optional
        Which axes know where they are; all of them where it is left out.
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
        homing: Homing | None = None,
    ) -> None:
        self._robot = robot
        self._homing = homing if homing is not None else Homing(())
        self._profile: ProfileMotion | None = None
        self._plant = Plant.of(robot, closed_loop=True)
        # The plant counts from the latest sample: its steps stay exact however long it runs.
        self._state = self._plant.at_rest(0.0, position)
        axes = robot.axes.values()
        self._has_voltage = np.array([not isinstance(axis, StepperAxis) for axis in axes])
        self._setpoints = SetpointGenerator(SetpointLimits.of(robot), tick_s, position)
        self._compensating = Compensating(SetpointLimits.of(robot), tick_s)
        self._regulating = Regulating(tick_s)
        # How far a loop that holds a stopped axis may lead its output away.
        self._holding = np.array([axis.following for axis in axes])
        self._command = np.array(position, dtype=np.float64)
        self._sent = self._command
        self._tick_s = tick_s
        self._seed = seed
        self._settle_s = settle_s
        self._chance = Chance(np.random.default_rng(seed))
        self._laser = np.random.default_rng([seed, _LASER])  # apart: it changes no sensor's noise
        noise = robot.reference.noise_rms
        self._laser_rms = np.array([noise.of(axis.unit) or 0.0 for axis in axes])
        self._phase = _Phase.HOLD
        self._playing: Playing | None = None
        self._settled = 0
        self._plays = 0
        # Ticks are counted from an anchor: adding intervals up would let rounding grow.
        self._anchor_s = time_s
        self._ticks = -1

    @property
    def time_s(self) -> float:
        """Device time of the latest sample; a tick before the first one at the very start."""
        if self._phase is _Phase.ROWS and self._playing is not None and self._playing.begun:
            return self._playing.time_s
        return self._anchor_s + self._ticks * self._tick_s

    @property
    def command(self) -> FloatArray:
        """The latest desired set-points (axes,), m or rad, also during playback."""
        return self._command.copy()

    @property
    def sent(self) -> FloatArray:
        """The latest commands to the actuators (axes,), m or rad."""
        return self._sent.copy()

    @property
    def compensated(self) -> dict[int, Exceedance]:
        """In what each axis, by its number, has gone beyond its inverse; of those that have one."""
        return self._compensating.beyond

    @property
    def regulated(self) -> dict[int, Regulation]:
        """The loops that are closed, by the number of their axis; any thread may ask."""
        return dict(self._regulating.regulations)

    @property
    def limited(self) -> tuple[int, ...]:
        """The axes, by their number, whose loop a limit cuts off at present."""
        return tuple(index for index in self.regulated if self._regulating.limited(index))

    @property
    def tick_s(self) -> float:
        """Interval between set-points at present."""
        return self._tick_s

    @property
    def true_position(self) -> FloatArray:
        """Where the axes (axes,) are, m or rad, with every effect and without a sensor's."""
        return np.asarray(self._state.position[-1])

    @property
    def moving(self) -> bool:
        """Whether a single move, or the halt after a stop, is under way."""
        return self._setpoints.moving

    @property
    def playing(self) -> bool:
        """Whether a profile or a trajectory is playing, its approach included."""
        return self._phase is not _Phase.HOLD

    @property
    def running_profile(self) -> bool:
        """Whether it is a profile that is playing."""
        return self._phase is _Phase.PROFILE

    @property
    def progress(self) -> float:
        """How much of the present or latest trajectory, or profile, has been played, 0 to 1."""
        if self._profile is not None:
            return self._profile.progress
        return self._playing.progress if self._playing is not None else 0.0

    def with_effects(self, effects: tuple[AxisEffect, ...]) -> tuple[Plant, PlantState]:
        """Return a plant with other effects, where the axes are and as fast as they are."""
        plant = Plant.of(replace(self._robot, effects=effects), closed_loop=True)
        return plant, taken_over(plant, self._plant, self._state)

    def use(self, plant: Plant, state: PlantState) -> None:
        """Continue with another plant at a state of its own."""
        self._plant, self._state = plant, state

    def rest(self, index: int, model: InverseModel | None) -> Rest:
        """Return how an axis, by its number, rests under an inverse, or none; nothing changes.

        Raises
        ------
        CompensationError
            If the inverse does not reach where the axis stands.
        """
        if index in self._regulating.regulations:
            return Rest(None, float(self._sent[index]))  # the loop has it, in its feed-forward
        return self._compensating.rest(model, float(self._sent[index]))

    def compensate(self, index: int, model: InverseModel | None, rest: Rest) -> None:
        """Apply an inverse to an axis, by its number, or remove it; the axis rests.

        Raises
        ------
        CompensationError
            If the inverse of a loop's feed-forward does not reach where the axis stands.
        """
        loop = self._regulating.regulations.get(index)
        if loop is None:
            wanted = self._compensating.change(index, model, rest)
        else:
            wanted = self._compensating.lend(index, model, float(self._command[index]))
            self._regulating.put(index, loop, model, wanted, rest.command)
        self._rest_at(index, wanted)

    def regulate(self, index: int, regulation: Regulation | None) -> None:
        """Close a loop around an axis, by its number, or open it; the machine is at rest.

        Nothing jumps: a loop begins where the sensor says that the axis is, with the output that
        it was sent; where it ends, that output stays. An inverse in use goes over into the loop's
        feed-forward and back; one that does not reach that output is taken off with the loop.

        Raises
        ------
        FeedbackError, CompensationError
            If its rate does not fit, or the axis stands beyond what its inverse saw.
        """
        sent, model = float(self._sent[index]), self._compensating.model(index)
        if regulation is not None:
            self._regulating.check(index, regulation, alone=not any(self._plant.loops))
            offset = list(self._robot.axes.values())[index].offset
            wanted = float(self._state.reading[-1, index]) - offset
            wanted = self._compensating.lend(index, model, wanted)
            self._regulating.put(index, regulation, model, wanted, sent)
            self._retime()
        else:
            self._regulating.remove(index)
            self._retime()
            try:
                rest = self._compensating.rest(model, sent)
            except CompensationError:
                model, rest = None, Rest(None, sent)
            wanted = self._compensating.change(index, model, rest)
        self._rest_at(index, wanted)

    def _rest_at(self, index: int, wanted: float) -> None:
        """Take ``wanted`` for where an axis at rest is commanded to be."""
        self._setpoints.bound(index, *self._compensating.bounds(index))
        self._command[index] = wanted
        self._setpoints.take_over(self._command, np.zeros(len(self._command)))

    def _retime(self) -> None:
        """Go over to the ticks that the loops ask for."""
        tick_s = self._regulating.tick_s
        if tick_s != self._tick_s:
            self._anchor_s, self._ticks, self._tick_s = self.time_s, 0, tick_s
            self._setpoints.retime(tick_s)
            self._compensating.retime(tick_s)

    def move_to(self, index: int, target: float, most_speed: float | None = None) -> None:
        """Send an axis, by its number, to a target, no faster than this."""
        self._regulating.lead(index)
        self._setpoints.retarget({index: target}, most_speed)

    def drive(self, index: int, velocity: float) -> None:
        """Let an axis, by its number, go at a speed, m/s or rad/s; 0 brings it to a halt."""
        if velocity:
            self._regulating.lead(index)
        self._setpoints.drive(index, velocity)

    def playing_of(self, trajectory: Record) -> Playing:
        """Return a trajectory as the machine would play it now; nothing changes."""
        # Loops and inverses live at the ticks.
        on_ticks = any(self._plant.loops) or bool(self._compensating.beyond or self._regulating)
        return Playing(
            trajectory,
            self._plant.axes,
            self._tick_s,
            self._regulating.ticks,
            on_ticks=on_ticks,
            smooth=bool(self._regulating),
        )

    def play(self, playing: Playing) -> None:
        """Approach the first row, settle, then play."""
        self._profile = None
        self._regulating.lead()
        self._playing = playing
        self._settled = 0
        self._setpoints.retarget(playing.first)
        self._phase = _Phase.APPROACH

    def run(self, profile: ProfileMotion) -> None:
        """Run a profile of an axis from the next tick on; all axes are at rest."""
        self._regulating.lead(profile.index)
        self._profile = profile
        self._phase = _Phase.PROFILE

    def home(self, axes: tuple[int, ...]) -> None:
        """Send axes, by their number, to their switches; they are at rest."""
        self._homing.begin(axes, self._setpoints)

    def stop(self) -> None:
        """Halt within the acceleration that the axes allow, from whatever is continuing."""
        self._homing.give_up()
        if self._phase is _Phase.PROFILE and self._profile is not None:
            self._end_profile(self._profile)
        if self._phase is _Phase.ROWS and self._playing is not None and self._playing.begun:
            self._end_rows(self._command, self._playing)
        self._setpoints.stop()
        self._regulating.hold(self._holding)
        self._phase = _Phase.HOLD

    def advance(self, until_s: float) -> list[Samples]:
        """Advance until the last sample that is not after ``until_s``; return what was sampled.

        Raises
        ------
        PlantError
            If the motion leaves what a number can hold.
        """
        parts: list[Samples] = []
        while True:
            chunk = self._next_chunk(until_s)
            if not len(chunk.time_s):
                return parts
            if len(samples := self._sample(chunk)):
                parts.append(samples)

    def _next_chunk(self, until_s: float) -> Chunk:
        if self._phase is _Phase.ROWS and self._playing is not None:
            return self._row_chunk(self._playing, until_s)
        since = (until_s - self._anchor_s) / self._tick_s
        ticks = max(min(int(np.floor(since + 1e-6)) - self._ticks, _CHUNK), 0)
        if self._phase is _Phase.PROFILE and self._profile is not None:
            return self._profile_chunk(self._profile, ticks)
        return self._tick_chunk(ticks)

    def _profile_chunk(self, profile: ProfileMotion, ticks: int) -> Chunk:
        """Take at most ``ticks`` ticks of a profile, while the other axes hold."""
        way = profile.advance(ticks)
        command = np.tile(self._setpoints.position, (len(way), 1))
        command[:, profile.index] = way
        if len(way):
            self._command = command[-1].copy()
        chunk = self._on_ticks(command)
        if profile.ended:
            self._end_profile(profile)
        return chunk

    def _end_profile(self, profile: ProfileMotion) -> None:
        """Hold, or come to a halt, from the latest command of a profile and its speed."""
        velocity = np.zeros(len(self._plant.axes))
        if profile.ticks:
            velocity[profile.index] = profile.velocity()
        self._setpoints.take_over(self._command, velocity)
        self._phase = _Phase.HOLD

    def _tick_chunk(self, ticks: int) -> Chunk:
        """Take at most ``ticks`` ticks; a chunk ends where a phase does."""
        if self._phase is _Phase.SETTLE:
            ticks = min(ticks, self._settle_ticks - self._settled)
        approach = self._phase is _Phase.APPROACH
        command = self._setpoints.generate(ticks, until_rest=approach)
        self._homing.notice(self._setpoints)
        chunk = self._on_ticks(command)
        if approach and len(command) and not self._setpoints.moving:
            self._phase = _Phase.SETTLE
        elif self._phase is _Phase.SETTLE:
            self._settled += len(command)
        if self._phase is _Phase.SETTLE and self._settled >= self._settle_ticks:
            self._begin_rows(self._playing)
        return chunk

    @property
    def _settle_ticks(self) -> int:
        return round(self._settle_s / self._tick_s)

    def _on_ticks(self, command: FloatArray) -> Chunk:
        """Count the ticks of commands (n, axes) and say when they are."""
        number = np.arange(self._ticks + 1, self._ticks + 1 + len(command), dtype=np.int64)
        since = number - max(self._ticks, 0)
        self._ticks += len(command)
        return Chunk(
            (self._anchor_s + number * self._tick_s).astype(np.float64),
            (since * self._tick_s).astype(np.float64),
            command,
            np.full(len(command), -1, dtype=np.int64),
            number % self._regulating.ticks == 0,
        )

    def _begin_rows(self, playing: Playing | None) -> None:
        assert playing is not None, "a trajectory was approached"
        playing.begin(self._anchor_s + (self._ticks + 1) * self._tick_s)
        self._phase = _Phase.ROWS
        self._plays += 1

    def _row_chunk(self, playing: Playing, until_s: float) -> Chunk:
        if not playing.begun:
            self._chance = Chance(np.random.default_rng([self._seed, self._plays]))
        chunk = playing.take(until_s, self._setpoints.position, _CHUNK)
        if playing.ended and len(chunk.time_s):
            self._end_rows(chunk.command[-1], None)
        return chunk

    def _end_rows(self, command: FloatArray, playing: Playing | None) -> None:
        """Hold from the latest set-points (axes,) on, which rest or have a playback's speed."""
        velocity = np.zeros(len(command)) if playing is None else playing.velocity()
        self._anchor_s, self._ticks = self.time_s, 0
        self._setpoints.take_over(command, velocity)
        self._phase = _Phase.HOLD

    def _sample(self, chunk: Chunk) -> Samples:
        motion, state, sent = self._regulating.advance(
            self._plant,
            self._state,
            chunk.elapsed_s,
            chunk.command,
            self._compensating.sent(chunk.command),
            self._chance,
        )
        self._compensating.note(self._regulating.beyond)
        self._state = replace(state, time_s=state.time_s - state.time_s[-1])
        self._command, self._sent = chunk.command[-1].copy(), sent[-1].copy()
        inputs = np.where(self._has_voltage, motion.inputs, np.nan)
        noise = self._laser_rms * self._laser.standard_normal(motion.position.shape)
        seen = motion.position + noise
        samples = Samples(chunk.time_s, chunk.command, motion.reading, inputs, chunk.row, seen)
        return selected(samples, chunk.told)
