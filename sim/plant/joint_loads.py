"""Accelerations of a run, and the forces that balance at every joint.

The equation of motion, Eq. (1) of the paper, as forces::

    M q̈ + D q̇ + C q = E U + F + A Q̇ + B Q + f

It is taken at each sample just after its inputs began to act, for these are held until the next.
Q is held likewise, so ``A Q̇`` is an impulse at each sample at which Q changes, and nothing in
between: it is given as ``impulse``, and the velocities are those just after it.

What effects do to the axes is f, the rest. Where nothing disturbs a group of coupled axes, f is
zero and the acceleration follows from the equation, exactly. Where an effect acts, or an input is
late, the acceleration is that of the cubic through positions and velocities of a row and the next,
and f is what the balance then lacks; at the last row, f is that of the row before. Where an effect
shows an axis elsewhere than it is, such as backlash, its position tells nothing of its
acceleration, which is then the mean until the next row (in the last row, that of the row before).
These are good to the second and to the first order of the interval, so such a run wants many
samples in a period of its vibrations.

A static axis has no figures to make forces of: its forces are zero. It moves by differences:
its velocity is the mean until the next row (in the last row, that of the row before), and its
acceleration is the change of that velocity from the row before, as if it had stood still before
the first row.
"""

from dataclasses import dataclass, fields, replace
from typing import Self

import numpy as np

from rotemina.sim.arrays import FloatArray, read_only
from rotemina.sim.plant.equation import EquationMatrices
from rotemina.sim.plant.perturbation import Perturbation
from rotemina.sim.plant.plant import Plant
from rotemina.sim.plant.state import Motion


@dataclass(frozen=True, slots=True, eq=False)
class JointLoads:
    """What moves the axes of a plant: ``inertia + damping + stiffness = actuation + …``.

    All but ``time_s`` and the energies are (n, axes), in the plant's order; forces are in N, of
    an axis that turns in N m. An axis that its robot file gives by natural frequency and damping
    ratio has the mass 1 kg (1 kg m²).

    Attributes
    ----------
    time_s : (n,)
    position : m or rad, as seen from outside.
    velocity : m/s or rad/s, just after the impulse.
    acceleration : m/s² or rad/s², just after the inputs of the row began to act.
    inertia : ``M q̈``
    damping : ``D q̇``
    stiffness : ``C q``
    actuation : ``E U``
    constant : F, the offset of force axes.
    perturbation : ``B Q``
    rest : f, what effects and late inputs add.
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
        for each in fields(self):
            object.__setattr__(self, each.name, read_only(getattr(self, each.name)))

    def part(self, rows: slice) -> Self:
        """Return some of the rows."""
        return replace(self, **{each.name: getattr(self, each.name)[rows] for each in fields(self)})


def joint_loads(
    plant: Plant,
    time_s: FloatArray,
    motion: Motion,
    perturbation: Perturbation | None = None,
    *,
    shaken_before: FloatArray | None = None,
) -> JointLoads:
    """Return accelerations and forces of a run.

    Parameters
    ----------
    plant : Plant
    time_s : (n,)
        Of the samples.
    motion : Motion
        What :meth:`Plant.advance` returned for them, without chance or with it.
    perturbation : Perturbation, optional
        The one it was given.
    shaken_before : (axes,), optional
        Q before the first row; zero at the beginning of a run.

    Raises
    ------
    PlantError
        If the perturbation does not fit.
    """
    axes = len(plant.axes)
    if perturbation is None:
        perturbation = Perturbation(np.zeros((len(time_s), axes)), *np.zeros((2, axes, axes)))
    perturbation.check(len(time_s), plant.axes)
    before = np.zeros(axes) if shaken_before is None else shaken_before
    matrices = EquationMatrices.of(plant)
    change = np.diff(np.vstack([before, perturbation.acceleration]), axis=0)
    impulse = np.where(matrices.moving, change @ perturbation.a.T, 0.0)
    push = np.where(matrices.moving, perturbation.acceleration @ perturbation.b.T, 0.0)
    velocity = np.where(
        matrices.moving,
        motion.velocity + impulse @ matrices.inverse.T,
        _mean(time_s, motion.position, motion.position),
    )
    stiffness = motion.position @ matrices.stiffness.T
    damping = np.where(matrices.moving, velocity, 0.0) @ matrices.damping.T
    actuation = motion.inputs * matrices.input_gain
    applied = actuation + matrices.constant + push
    unbalanced = applied - damping - stiffness  # M q̈ − f
    rest = np.zeros_like(unbalanced)
    if matrices.disturbed.any() and len(time_s) > 1:
        smooth = _cubic(time_s, motion.position, velocity, motion.velocity)
        mean = _mean(time_s, velocity, motion.velocity)
        inertia = np.where(matrices.hidden, mean, smooth) @ matrices.mass.T
        rest = np.where(matrices.disturbed, inertia - unbalanced, 0.0)
        rest[-1] = np.where(matrices.hidden, rest[-1], rest[-2])
    acceleration = np.where(
        matrices.moving,
        (unbalanced + rest) @ matrices.inverse.T,
        _change_of_speed(time_s, velocity),
    )
    return JointLoads(
        time_s=time_s,
        position=motion.position,
        velocity=velocity,
        acceleration=acceleration,
        inertia=unbalanced + rest,
        damping=damping,
        stiffness=stiffness,
        actuation=actuation,
        constant=np.tile(matrices.constant, (len(time_s), 1)),
        perturbation=push,
        rest=rest,
        impulse=impulse,
        kinetic_energy=0.5 * np.einsum("ki,ij,kj->k", velocity, matrices.mass, velocity),
        elastic_energy=0.5 * np.sum(motion.position * stiffness, axis=1),
    )


class RunningLoads:
    """Loads of a run that comes in pieces, row for row those of the whole run.

    A row is given when the next one is known, as its acceleration may need that.
    """

    def __init__(self, plant: Plant) -> None:
        self._plant = plant
        self._shaken = np.zeros(len(plant.axes))  # Q before the first row that is held
        self._time_s = np.zeros(0)
        self._motion: Motion | None = None
        self._perturbation: Perturbation | None = None
        self._given = 0  # of the rows that are held

    def follow(
        self, time_s: FloatArray, motion: Motion, perturbation: Perturbation | None = None
    ) -> JointLoads:
        """Return the loads of all rows that are complete by the next rows of the run.

        ``perturbation`` must be given for every piece or for none.
        """
        if self._motion is not None:
            motion = Motion(*map(np.concatenate, zip(self._motion, motion, strict=True)))
            time_s = np.concatenate([self._time_s, time_s])
        if perturbation is not None and self._perturbation is not None:
            shaken = np.vstack([self._perturbation.acceleration, perturbation.acceleration])
            perturbation = replace(perturbation, acceleration=shaken)
        loads = joint_loads(
            self._plant, time_s, motion, perturbation, shaken_before=self._shaken
        ).part(slice(self._given, len(time_s) - 1))
        self._hold(time_s, motion, perturbation)
        return loads

    def last(self) -> JointLoads:
        """Return the loads of the last row of the run."""
        assert self._motion is not None
        whole = joint_loads(
            self._plant,
            self._time_s,
            self._motion,
            self._perturbation,
            shaken_before=self._shaken,
        )
        return whole.part(slice(self._given, None))

    def _hold(self, time_s: FloatArray, motion: Motion, perturbation: Perturbation | None) -> None:
        """Keep the last row and the one before, which says how fast a static axis was."""
        kept = slice(max(len(time_s) - 2, 0), None)
        if perturbation is not None:
            if kept.start > 0:
                self._shaken = perturbation.acceleration[kept.start - 1]
            self._perturbation = perturbation.part(kept)
        self._time_s, self._motion = time_s[kept], Motion(*(signal[kept] for signal in motion))
        self._given = len(self._time_s) - 1


def _mean(time_s: FloatArray, leaving: FloatArray, arriving: FloatArray) -> FloatArray:
    """Return the mean rate (n, axes) from each row to the next; the last repeats.

    ``leaving`` and ``arriving`` are the values behind and before an impulse at the row.
    """
    if len(time_s) < 2:
        return np.zeros_like(leaving)
    rate = (arriving[1:] - leaving[:-1]) / np.diff(time_s)[:, None]
    return np.asarray(np.vstack([rate, rate[-1:]]))


def _change_of_speed(time_s: FloatArray, speed: FloatArray) -> FloatArray:
    """Return how fast a speed that holds from each row to the next changes, (n, axes)."""
    if len(time_s) < 2:
        return np.zeros_like(speed)
    interval = np.diff(time_s)
    apart = 0.5 * (np.append(interval, interval[-1]) + np.insert(interval, 0, interval[0]))
    before = np.vstack([np.zeros_like(speed[:1]), speed[:-1]])
    return np.asarray((speed - before) / apart[:, None])


def _cubic(
    time_s: FloatArray, position: FloatArray, leaving: FloatArray, arriving: FloatArray
) -> FloatArray:
    """Return accelerations (n, axes) at the rows, of Hermite's cubic to the next; the last repeats.

    ``leaving`` and ``arriving`` are the velocities behind and before an impulse at the row.
    """
    h = np.diff(time_s)[:, None]
    slope = np.diff(position, axis=0) / h
    begin, end = leaving[:-1], arriving[1:]
    ahead = (6.0 * slope - 4.0 * begin - 2.0 * end) / h
    return np.asarray(np.vstack([ahead, ahead[-1:]]))
