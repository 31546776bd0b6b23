"""A machine with parts that its model lacks: what its taps show for given commands."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import mechanics
from rotemina.sim.blind.mechanics import Structure
from rotemina.sim.blind.part import Axis, Part, SimulationRun, Stage
from rotemina.sim.robot.matrices import inertia_matrices
from rotemina.sim.robot.model import PiezoAxis, Robot, StepperAxis

_FINE_S = 5e-5
_LEAD_S = 0.9
_LEAD_RISE_S = 0.45
_LEAD_TRAVEL_M = 1.5e-4  # of a stepper: longer than its memory, slow enough not to coast


class Commands(NamedTuple):
    """``values`` (n, m) SI, one row every ``step_s``, each held until the next."""

    step_s: float
    values: FloatArray


class Response(NamedTuple):
    """What happens at the samples, without noise: each (n, m), SI positions."""

    drive: FloatArray
    motion: FloatArray
    reading: FloatArray


@dataclass(frozen=True, slots=True)
class Machine:
    """The axes that move together, their nominal structure and what it lacks."""

    axes: tuple[Axis, ...]
    structure: Structure
    parts: tuple[Part, ...] = ()

    def having(self, parts: Sequence[Part]) -> "Machine":
        """Return the machine with other parts."""
        return Machine(self.axes, self.structure, tuple(parts))

    def respond(self, commands: Commands, seed: int) -> Response:
        """Run the machine over the commands, after a rise to the first one, long ago."""
        every = int(np.ceil(commands.step_s / _FINE_S - 1e-9))
        step_s = commands.step_s / every
        run = SimulationRun(step_s, every, round(_LEAD_S / step_s), seed)
        drive = self._driven(np.repeat(commands.values, every, axis=0), run)
        targets = self._through(drive, run, Stage.ACTUATOR)
        motion = self._moved(targets, run)
        passed = self._through(motion, run, Stage.SENSOR)
        rows = slice(run.lead, None, every)
        reading = self._through(passed[rows], run, Stage.READING)
        return Response(drive[rows], motion[rows], reading)

    def _of(self, stage: Stage) -> list[Part]:
        return [part for part in self.parts if part.stage is stage]

    def _driven(self, commanded: FloatArray, run: SimulationRun) -> FloatArray:
        share = np.arange(run.lead) * run.step_s / _LEAD_RISE_S
        rise = 0.5 - 0.5 * np.cos(np.pi * np.minimum(share, 1.0))
        first = commanded[0]
        low = np.array([axis.low for axis in self.axes])
        near = np.array([axis.kind == "stepper" for axis in self.axes])
        origin = np.where(near, np.maximum(low, first - _LEAD_TRAVEL_M), low)
        lead = origin + rise[:, None] * (first - origin)
        return self._through(np.concatenate([lead, commanded]), run, Stage.DRIVE)

    def _through(self, values: FloatArray, run: SimulationRun, stage: Stage) -> FloatArray:
        out = values.copy(order="F")
        for part in self._of(stage):
            i = part.axis.index
            out[:, i] = part.act(out[:, i].copy(), run, part.size)
        return out

    def _moved(self, targets: FloatArray, run: SimulationRun) -> FloatArray:
        nothing = np.zeros(0)
        loads = [part.act(nothing, run, part.size) for part in self._of(Stage.LOAD)]
        table = np.array(loads).reshape(-1, mechanics.ROW)
        structure = self.structure
        for part in self._of(Stage.STRUCTURE):
            for change in np.atleast_2d(part.act(nothing, run, part.size)):
                structure = _changed(structure, change)
        plain = mechanics.move(structure, targets, table, run.step_s)
        motion = plain.copy()
        for part in self._of(Stage.MOTION):
            motion[:, part.axis.index] += part.act(plain, run, part.size)
        return motion


def _changed(structure: Structure, change: FloatArray) -> Structure:
    """Scale an axis' stiffness and damping (code 0) or hang a mass on it (code 1)."""
    mass, damping, stiffness = (matrix.copy() for matrix in structure[:3])
    drive, i = structure.drive.copy(), int(change[1])
    if change[0] == 0.0:
        stiffness[i, i] *= change[2]
        damping[i, i] *= change[3]
        drive[i] *= change[2]
        return Structure(mass, damping, stiffness, drive)
    share, frequency_hz, ratio = change[2:5]
    hung, rate = share * mass[i, i], 2.0 * np.pi * frequency_hz
    return Structure(
        _hung(mass, i, hung, joined=False),
        _hung(damping, i, 2.0 * ratio * rate * hung, joined=True),
        _hung(stiffness, i, rate**2 * hung, joined=True),
        drive,
    )


def _hung(matrix: FloatArray, i: int, value: float, *, joined: bool) -> FloatArray:
    """Return ``matrix`` with one more coordinate, tied to coordinate ``i`` if ``joined``."""
    d = len(matrix)
    out = np.zeros((d + 1, d + 1))
    out[:d, :d] = matrix
    out[d, d] = value
    if joined:
        out[i, i] += value
        out[i, d] = out[d, i] = -value
    return out


def machine_of(robot: Robot, names: Sequence[str], travels: Mapping[str, FloatArray]) -> Machine:
    """Build the nominal machine of some axes; ``travels``: lowest and highest command of each.

    Axes that are coupled to them ride along: they stay where they are but for the coupling.
    """
    whole = inertia_matrices(robot)
    coupled = [set(coupling.axes) for coupling in robot.couplings]
    riding = [
        n for n in whole.axes if n not in names and any(n in c and c & set(names) for c in coupled)
    ]
    rows = [whole.axes.index(name) for name in (*names, *riding)]
    mass, damping, stiffness = (matrix[np.ix_(rows, rows)] for matrix in whole[1:])
    axes = tuple(_axis(robot, name, i, travels[name]) for i, name in enumerate(names))
    drive = np.diag(stiffness)[: len(names)].copy()
    return Machine(axes, Structure(mass, damping, stiffness, drive))


def _axis(robot: Robot, name: str, index: int, travel: FloatArray) -> Axis:
    axis = robot.axes[name]
    sensor, inertia = axis.sensor, axis.inertia
    if sensor is None or inertia is None or not isinstance(axis, PiezoAxis | StepperAxis):
        raise ValueError(f"axis {name}: the generator needs a sensor, a mass and a spring")
    pitch = axis.pitch or 0.0 if isinstance(axis, StepperAxis) else 0.0
    steps = axis.steps_per_rev or 1 if isinstance(axis, StepperAxis) else 1
    return Axis(
        name,
        index,
        axis.kind,
        axis.range[0],
        axis.span,
        float(travel[0]),
        float(travel[1] - travel[0]),
        sensor.noise_floor,
        sensor.resolution,
        sensor.noise_rms,
        *inertia,
        pitch,
        pitch / steps,
    )
