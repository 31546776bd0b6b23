"""A simulated machine for blind tests: it has effects that its model lacks."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.blind import mechanics
from rotemina.sim.blind.mechanics import LinearStructure
from rotemina.sim.blind.part import BlindAxis, EffectPart, SignalStage, SimulationRun
from rotemina.sim.robot import (
    PiezoAxis,
    Robot,
    StepperAxis,
    assemble_inertia_matrices,
)

# The machine is simulated on a fine grid with at most this step.
_MAX_STEP_S = 5e-5
# Each simulation begins with a lead-in before the record: a rise, and then rest.
_LEAD_IN_S = 0.9
_LEAD_IN_RISE_S = 0.45
# During the lead-in, a stepper travels far enough to erase the memory of backlash and friction, but
# slowly enough not to move on after its command has stopped.
_STEPPER_LEAD_IN_TRAVEL_M = 1.5e-4


class SampledCommands(NamedTuple):
    """Commands ``values`` (n, m), SI, one row every ``step_s``, each held until the next."""

    step_s: float
    values: FloatArray


class MachineResponse(NamedTuple):
    """The noise-free signals at the samples, each (n, m), positions in SI."""

    drive: FloatArray
    motion: FloatArray
    reading: FloatArray


@dataclass(frozen=True, slots=True)
class BlindMachine:
    """Axes that move together, their nominal structure, and effects that the model lacks."""

    axes: tuple[BlindAxis, ...]
    structure: LinearStructure
    parts: tuple[EffectPart, ...] = ()

    def with_parts(self, parts: Sequence[EffectPart]) -> "BlindMachine":
        """Return a copy of the machine with other effects."""
        return BlindMachine(self.axes, self.structure, tuple(parts))

    def respond(self, commands: SampledCommands, seed: int) -> MachineResponse:
        """Simulate the machine over the commands.

        Before the record, the machine rises to the first command and settles.
        """
        substeps = int(np.ceil(commands.step_s / _MAX_STEP_S - 1e-9))
        step_s = commands.step_s / substeps
        run = SimulationRun(
            step_s=step_s,
            rows_per_sample=substeps,
            lead=round(_LEAD_IN_S / step_s),
            seed=seed,
        )
        drive = self._simulate_drive(np.repeat(commands.values, substeps, axis=0), run)
        targets = self._apply_parts(drive, run, SignalStage.ACTUATOR)
        motion = self._simulate_motion(targets, run)
        sensor_output = self._apply_parts(motion, run, SignalStage.SENSOR)
        rows = slice(run.lead, None, substeps)
        reading = self._apply_parts(sensor_output[rows], run, SignalStage.READING)
        return MachineResponse(drive[rows], motion[rows], reading)

    def _find_parts(self, stage: SignalStage) -> list[EffectPart]:
        return [part for part in self.parts if part.stage is stage]

    def _simulate_drive(self, commanded: FloatArray, run: SimulationRun) -> FloatArray:
        progress = np.arange(run.lead) * run.step_s / _LEAD_IN_RISE_S
        rise = 0.5 - 0.5 * np.cos(np.pi * np.minimum(progress, 1.0))
        first = commanded[0]
        low = np.array([axis.low for axis in self.axes])
        is_stepper = np.array([axis.kind == "stepper" for axis in self.axes])
        origin = np.where(is_stepper, np.maximum(low, first - _STEPPER_LEAD_IN_TRAVEL_M), low)
        lead_in = origin + rise[:, None] * (first - origin)
        return self._apply_parts(np.concatenate([lead_in, commanded]), run, SignalStage.DRIVE)

    def _apply_parts(
        self, values: FloatArray, run: SimulationRun, stage: SignalStage
    ) -> FloatArray:
        out = values.copy(order="F")
        for part in self._find_parts(stage):
            i = part.axis.index
            out[:, i] = part.act(out[:, i].copy(), run, part.size)
        return out

    def _simulate_motion(self, targets: FloatArray, run: SimulationRun) -> FloatArray:
        # Loads and changes of the structure do not depend on a signal.
        no_signal = np.zeros(0)
        loads = [part.act(no_signal, run, part.size) for part in self._find_parts(SignalStage.LOAD)]
        load_rows = np.array(loads).reshape(-1, mechanics.LOAD_ROW_LENGTH)
        structure = self.structure
        for part in self._find_parts(SignalStage.STRUCTURE):
            for change in np.atleast_2d(part.act(no_signal, run, part.size)):
                structure = _change_structure(structure, change)
        structural_motion = mechanics.simulate_motion(structure, targets, load_rows, run.step_s)
        motion = structural_motion.copy()
        for part in self._find_parts(SignalStage.MOTION):
            motion[:, part.axis.index] += part.act(structural_motion, run, part.size)
        return motion


def _change_structure(structure: LinearStructure, change: FloatArray) -> LinearStructure:
    """Return the structure after a change of the axis in column i.

    ``change`` is (0, i, stiffness factor, damping factor), or (1, i, mass ratio, frequency in Hz,
    damping ratio) for a mass that a spring and a damper attach to the axis.
    """
    mass, damping, stiffness = (matrix.copy() for matrix in structure[:3])
    drive_stiffness, i = structure.drive.copy(), int(change[1])
    if change[0] == 0.0:
        stiffness[i, i] *= change[2]
        damping[i, i] *= change[3]
        drive_stiffness[i] *= change[2]
        return LinearStructure(mass, damping, stiffness, drive_stiffness)
    mass_ratio, frequency_hz, damping_ratio = change[2:5]
    attached_mass, frequency_rad_s = mass_ratio * mass[i, i], 2.0 * np.pi * frequency_hz
    attached_damping = 2.0 * damping_ratio * frequency_rad_s * attached_mass
    attached_stiffness = frequency_rad_s**2 * attached_mass
    return LinearStructure(
        _add_coordinate(mass, i, attached_mass, is_coupled=False),
        _add_coordinate(damping, i, attached_damping, is_coupled=True),
        _add_coordinate(stiffness, i, attached_stiffness, is_coupled=True),
        drive_stiffness,
    )


def _add_coordinate(matrix: FloatArray, i: int, value: float, *, is_coupled: bool) -> FloatArray:
    d = len(matrix)
    extended = np.zeros((d + 1, d + 1))
    extended[:d, :d] = matrix
    extended[d, d] = value
    if is_coupled:
        extended[i, i] += value
        extended[i, d] = extended[d, i] = -value
    return extended


def build_machine(
    robot: Robot, names: Sequence[str], travels: Mapping[str, FloatArray]
) -> BlindMachine:
    """Build a machine without effects from axes of a robot.

    ``travels`` holds the lowest and highest command of each axis. The machine also includes the
    other axes that are coupled to these axes; they are not driven, so only the coupling moves them.
    """
    matrices = assemble_inertia_matrices(robot)
    coupled = [set(coupling.axes) for coupling in robot.couplings]
    passive = [
        n
        for n in matrices.axes
        if n not in names and any(n in c and c & set(names) for c in coupled)
    ]
    rows = [matrices.axes.index(name) for name in (*names, *passive)]
    mass, damping, stiffness = (
        matrix[np.ix_(rows, rows)]
        for matrix in (matrices.mass, matrices.damping, matrices.stiffness)
    )
    axes = tuple(_build_axis(robot, name, i, travels[name]) for i, name in enumerate(names))
    drive_stiffness = np.diag(stiffness)[: len(names)].copy()
    return BlindMachine(axes, LinearStructure(mass, damping, stiffness, drive_stiffness))


def _build_axis(robot: Robot, name: str, index: int, travel: FloatArray) -> BlindAxis:
    axis = robot.axes[name]
    sensor, inertia = axis.sensor, axis.inertia
    if sensor is None or inertia is None or not isinstance(axis, PiezoAxis | StepperAxis):
        raise ValueError(
            f"axis {name}: a blind test needs a piezo or stepper axis with a sensor and dynamics"
        )
    pitch = (axis.pitch or 0.0) if isinstance(axis, StepperAxis) else 0.0
    steps_per_rev = (axis.steps_per_rev or 1) if isinstance(axis, StepperAxis) else 1
    return BlindAxis(
        name=name,
        index=index,
        kind=axis.kind,
        low=axis.range[0],
        span=axis.span,
        start=float(travel[0]),
        travel=float(travel[1] - travel[0]),
        floor=sensor.noise_floor,
        resolution=sensor.resolution,
        noise=sensor.noise_rms,
        mass=inertia.mass,
        damping=inertia.damping,
        stiffness=inertia.stiffness,
        pitch=pitch,
        full_step=pitch / steps_per_rev,
    )
