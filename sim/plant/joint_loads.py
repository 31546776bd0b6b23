"""Accelerations of a run, and the forces that balance at every joint.

The equation of motion, Eq. (1) of the paper, as forces::

    M q̈ + D q̇ + C q = E U + F + A Q̇ + B Q + f

It is evaluated at each sample just after the inputs of that sample began to act, because they are
held until the next one. Q is held likewise. ``A Q̇`` is therefore an impulse at each sample at
which Q changes, and zero in between. It is given as ``impulse``, and the velocities are those just
after it.

f is the force by which effects act on the axes. If nothing disturbs a group of coupled axes, f is
zero and the acceleration follows exactly from the equation. If an effect acts, or an input is
delayed, the acceleration is that of the cubic through positions and velocities of a row and the
next one, and f is the force that the balance then lacks. In the last row, f is that of the row
before. If an effect changes the observed position of an axis, as backlash does, the position gives
no acceleration. The acceleration is then the mean until the next row (in the last row, that of the
row before). These two accelerations are accurate to second and first order of the interval, so such
a run needs many samples per period of its vibrations.

A static axis has no mass, damping or stiffness: its forces are zero. Its velocity is the mean until
the next row (in the last row, that of the row before). Its acceleration is the change of that
velocity from the row before, as if it had stood still before the first row.
"""

from dataclasses import dataclass, fields, replace
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray, make_read_only
from rotemina.sim.plant.equation import EquationMatrices
from rotemina.sim.plant.perturbation import Perturbation
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.state import PlantMotion


@dataclass(frozen=True, slots=True, eq=False)
class JointLoads:
    """Motion and forces of the axes: ``inertia + damping + stiffness = actuation + …``.

    All but ``time_s`` and the energies are (n, axes), in the plant's order. Forces are in N, or in
    N m for an axis that turns. An axis that its robot file describes by natural frequency and
    damping ratio has the mass 1 kg (1 kg m²).

    Attributes
    ----------
    time_s : (n,)
    position : m or rad, as observed.
    velocity : m/s or rad/s, just after the impulse.
    acceleration : m/s² or rad/s², just after the inputs of the row began to act.
    inertia : ``M q̈``
    damping : ``D q̇``
    stiffness : ``C q``
    actuation : ``E U``
    constant : F, the offset of force axes.
    perturbation : ``B Q``
    rest : f, the force of effects and delayed inputs.
    impulse : ``A ΔQ``, N s or N m s.
    kinetic_energy, elastic_energy : (n,)
        ``½ q̇ᵀ M q̇`` and ``½ qᵀ C q``, J.
    """

    time_s: FloatArray
    position: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    inertia: FloatArray
    damping: FloatArray
    stiffness: FloatArray
    actuation: FloatArray
    constant: FloatArray
    perturbation: FloatArray
    rest: FloatArray
    impulse: FloatArray
    kinetic_energy: FloatArray
    elastic_energy: FloatArray

    def __post_init__(self) -> None:
        for attribute in fields(self):
            object.__setattr__(self, attribute.name, make_read_only(getattr(self, attribute.name)))

    def part(self, rows: slice) -> Self:
        """Return some of the rows."""
        return replace(
            self,
            **{attribute.name: getattr(self, attribute.name)[rows] for attribute in fields(self)},
        )


def compute_joint_loads(
    plant: Plant,
    time_s: FloatArray,
    motion: PlantMotion,
    perturbation: Perturbation | None = None,
    *,
    previous_acceleration: FloatArray | None = None,
) -> JointLoads:
    """Compute accelerations and forces of a run.

    Parameters
    ----------
    plant : Plant
    time_s : (n,)
        Sample times.
    motion : PlantMotion
        Result of :meth:`Plant.advance` for these samples, with or without noise.
    perturbation : Perturbation, optional
        The one that was passed to :meth:`Plant.advance`.
    previous_acceleration : (axes,), optional
        Q before the first row; zero at the beginning of a run.

    Raises
    ------
    PlantError
        If the perturbation does not fit the plant or the samples.
    """
    axis_count = len(plant.axes)
    if perturbation is None:
        perturbation = Perturbation(
            np.zeros((len(time_s), axis_count)), *np.zeros((2, axis_count, axis_count))
        )
    perturbation.check(len(time_s), plant.axes)
    initial_acceleration = (
        np.zeros(axis_count) if previous_acceleration is None else previous_acceleration
    )
    matrices = EquationMatrices.of(plant)
    acceleration_change = np.diff(
        np.vstack([initial_acceleration, perturbation.acceleration]), axis=0
    )
    impulse = np.where(matrices.moving, acceleration_change @ perturbation.a.T, 0.0)
    perturbation_force = np.where(
        matrices.moving, perturbation.acceleration @ perturbation.b.T, 0.0
    )
    velocity = np.where(
        matrices.moving,
        motion.velocity + impulse @ matrices.inverse.T,
        _compute_mean_rate(time_s, motion.position, motion.position),
    )
    stiffness = motion.position @ matrices.stiffness.T
    damping = np.where(matrices.moving, velocity, 0.0) @ matrices.damping.T
    actuation = motion.inputs * matrices.input_gain
    applied = actuation + matrices.constant + perturbation_force
    # The net force without f, which equals M q̈ − f.
    net_force = applied - damping - stiffness
    rest = np.zeros_like(net_force)
    if matrices.disturbed.any() and len(time_s) > 1:
        cubic_acceleration = _compute_cubic_acceleration(
            time_s, motion.position, velocity, motion.velocity
        )
        mean_acceleration = _compute_mean_rate(time_s, velocity, motion.velocity)
        inertia = (
            np.where(matrices.has_observation_effect, mean_acceleration, cubic_acceleration)
            @ matrices.mass.T
        )
        rest = np.where(matrices.disturbed, inertia - net_force, 0.0)
        rest[-1] = np.where(matrices.has_observation_effect, rest[-1], rest[-2])
    acceleration = np.where(
        matrices.moving,
        (net_force + rest) @ matrices.inverse.T,
        _compute_speed_change(time_s, velocity),
    )
    return JointLoads(
        time_s=time_s,
        position=motion.position,
        velocity=velocity,
        acceleration=acceleration,
        inertia=net_force + rest,
        damping=damping,
        stiffness=stiffness,
        actuation=actuation,
        constant=np.tile(matrices.constant, (len(time_s), 1)),
        perturbation=perturbation_force,
        rest=rest,
        impulse=impulse,
        kinetic_energy=0.5 * np.einsum("ki,ij,kj->k", velocity, matrices.mass, velocity),
        elastic_energy=0.5 * np.sum(motion.position * stiffness, axis=1),
    )


class RunningLoads:
    """Loads of a run that arrives in pieces; every row equals that of the whole run.

    A row is returned when the next one is known, because its acceleration may depend on it.
    """

    def __init__(self, plant: Plant) -> None:
        self._plant = plant
        # Q before the first stored row.
        self._previous_acceleration = np.zeros(len(plant.axes))
        self._time_s = np.zeros(0)
        self._motion: PlantMotion | None = None
        self._perturbation: Perturbation | None = None
        # Number of stored rows whose loads were already returned.
        self._returned_row_count = 0

    def follow(
        self, time_s: FloatArray, motion: PlantMotion, perturbation: Perturbation | None = None
    ) -> JointLoads:
        """Return the loads of all rows that are complete with the next rows of the run.

        ``perturbation`` must be given for every piece or for none.
        """
        if self._motion is not None:
            motion = PlantMotion(*map(np.concatenate, zip(self._motion, motion, strict=True)))
            time_s = np.concatenate([self._time_s, time_s])
        if perturbation is not None and self._perturbation is not None:
            acceleration = np.vstack([self._perturbation.acceleration, perturbation.acceleration])
            perturbation = replace(perturbation, acceleration=acceleration)
        loads = compute_joint_loads(
            self._plant,
            time_s,
            motion,
            perturbation,
            previous_acceleration=self._previous_acceleration,
        ).part(slice(self._returned_row_count, len(time_s) - 1))
        self._store_last_rows(time_s, motion, perturbation)
        return loads

    def compute_last(self) -> JointLoads:
        """Return the loads of the last row of the run."""
        assert self._motion is not None
        loads = compute_joint_loads(
            self._plant,
            self._time_s,
            self._motion,
            self._perturbation,
            previous_acceleration=self._previous_acceleration,
        )
        return loads.part(slice(self._returned_row_count, None))

    def _store_last_rows(
        self, time_s: FloatArray, motion: PlantMotion, perturbation: Perturbation | None
    ) -> None:
        """Keep the last row and the one before, which gives the speed of a static axis."""
        rows = slice(max(len(time_s) - 2, 0), None)
        if perturbation is not None:
            if rows.start > 0:
                self._previous_acceleration = perturbation.acceleration[rows.start - 1]
            self._perturbation = perturbation.part(rows)
        self._time_s, self._motion = time_s[rows], PlantMotion(*(signal[rows] for signal in motion))
        self._returned_row_count = len(self._time_s) - 1


def _compute_mean_rate(time_s: FloatArray, leaving: FloatArray, arriving: FloatArray) -> FloatArray:
    """Return the mean rate (n, axes) from each row to the next; the last row repeats.

    ``leaving`` and ``arriving`` are the values after and before an impulse at the row.
    """
    if len(time_s) < 2:
        return np.zeros_like(leaving)
    rate = (arriving[1:] - leaving[:-1]) / np.diff(time_s)[:, None]
    return np.asarray(np.vstack([rate, rate[-1:]]))


def _compute_speed_change(time_s: FloatArray, speed: FloatArray) -> FloatArray:
    """Return the rate (n, axes) of a speed that is constant from each row to the next."""
    if len(time_s) < 2:
        return np.zeros_like(speed)
    interval = np.diff(time_s)
    spacing = 0.5 * (np.append(interval, interval[-1]) + np.insert(interval, 0, interval[0]))
    previous_speed = np.vstack([np.zeros_like(speed[:1]), speed[:-1]])
    return np.asarray((speed - previous_speed) / spacing[:, None])


def _compute_cubic_acceleration(
    time_s: FloatArray, position: FloatArray, leaving: FloatArray, arriving: FloatArray
) -> FloatArray:
    """Return accelerations (n, axes) at the rows, of Hermite's cubic to the next row.

    The last row repeats. ``leaving`` and ``arriving`` are the velocities after and before an
    impulse at the row.
    """
    h = np.diff(time_s)[:, None]
    slope = np.diff(position, axis=0) / h
    start_velocity, end_velocity = leaving[:-1], arriving[1:]
    acceleration = (6.0 * slope - 4.0 * start_velocity - 2.0 * end_velocity) / h
    return np.asarray(np.vstack([acceleration, acceleration[-1:]]))
