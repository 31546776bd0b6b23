"""Poles of sampled position loops: axes under their controllers at one sample rate.

Between samples the plant is stepped exactly (zero-order hold). With the controller's law, away
from its limit and with the command at zero,

    u_k = −kv (kp q_k + v_k),   v_k = q̇_k  or  (q_k − q_{k−1})/Δt,

and its output delayed by ``n Δt + δ``, 0 ≤ δ < Δt (Åström and Wittenmark, "Computer-Controlled
Systems", 3rd ed. (1997), sec. 2.3)::

    s_{k+1} = Φ(Δt) s_k + Γ(Δt − δ) u_{k−n} + Φ(Δt − δ) Γ(δ) u_{k−n−1}

is linear in ``z_k = [s_k, q_{k−1}, u_{k−1}, …, u_{k−n−1}]``: the eigenvalues of ``z_k → z_{k+1}``
are the loop's poles, stable inside the unit circle.
"""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import ComplexArray, FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.messages import message
from rotemina.sim.plant.group import Group, groups_of
from rotemina.sim.plant.sampling import step_matrices
from rotemina.sim.robot.model import CascadeController, Robot
from rotemina.sim.trajectory.limits import controller_of

_WHOLE = 1e-9  # share of a sample interval within which a delay counts as whole intervals


class LoopError(InputError):
    """A closed loop that cannot be analysed."""


@dataclass(frozen=True, slots=True, eq=False)
class LoopPoles:
    """Poles z of one group of axes with its loops closed, sampled every ``interval_s``.

    Attributes
    ----------
    axes : tuple of str
        The group; those without a controller are held at their inputs.
    interval_s : float
    matrix : (r, r)
        ``z_{k+1} = matrix z_k``; the first 2m entries are the group's positions and velocities.
    poles : (r,) complex
    """

    axes: tuple[str, ...]
    interval_s: float
    matrix: FloatArray
    poles: ComplexArray

    @property
    def stable(self) -> bool:
        """Whether all poles lie inside the unit circle."""
        return bool(np.abs(self.poles).max() < 1.0)

    @property
    def message(self) -> str:
        """The verdict with the pole that decides, for a person."""
        largest = float(np.abs(self.poles).max())
        rate_hz = 1.0 / self.interval_s
        word, where = ("stable", "inside") if self.stable else ("unstable", "not inside")
        return (
            f"{' '.join(self.axes)}: loop {word} at {rate_hz:.6g} Hz; the largest pole "
            f"{largest:.9g} is {where} the unit circle"
        )


def loop_poles(robot: Robot, rate_hz: float) -> tuple[LoopPoles, ...]:
    """Return the poles of each group of coupled axes that has a controller, at a sample rate.

    Raises
    ------
    LoopError
        If no axis has a controller, or the rate is not positive and finite.
    """
    if not 0.0 < rate_hz < float("inf"):
        raise LoopError(
            message("engine", "sample rate {rate_hz} Hz: must be positive and finite").fill(
                rate_hz=rate_hz
            )
        )
    closed = [(group, _controllers(robot, group)) for group in groups_of(robot)]
    found = tuple(_close(group, loops, 1.0 / rate_hz) for group, loops in closed if loops)
    if not found:
        raise LoopError(
            message(
                "engine",
                "robot {name}: no axis has a controller; add [axis.….controller] to its file",
            ).fill(name=repr(robot.name))
        )
    return found


def _controllers(robot: Robot, group: Group) -> dict[int, CascadeController]:
    """Return the controllers of a group by the place of their axis in it."""
    loops = {i: controller_of(robot.axes[name]) for i, name in enumerate(group.axes)}
    return {i: loop for i, loop in loops.items() if loop is not None}


def _close(group: Group, loops: dict[int, CascadeController], interval_s: float) -> LoopPoles:
    """Assemble ``z_k → z_{k+1}``: states, positions before, then the old inputs of each loop."""
    m = group.size
    held = {i: _intervals(loop, interval_s) for i, loop in loops.items()}
    size = 3 * m + sum(whole + 1 for whole, _ in held.values())
    matrix, first = np.zeros((size, size)), 3 * m
    matrix[: 2 * m, : 2 * m] = step_matrices(group, np.array([interval_s]))[0][0]
    matrix[2 * m : 3 * m, :m] = np.eye(m)
    for i, loop in loops.items():
        whole, part = held[i]
        law = _law(loop, i, m, size, interval_s)
        # Row j of ``inputs`` gives u_{k−j} from z_k.
        inputs = np.vstack([law, np.eye(size)[first : first + whole + 1]])
        early, late = _input_steps(group, i, interval_s, part)
        matrix[: 2 * m] += np.outer(early, inputs[whole]) + np.outer(late, inputs[whole + 1])
        matrix[first : first + whole + 1] = inputs[: whole + 1]
        first += whole + 1
    return LoopPoles(group.axes, interval_s, matrix, np.linalg.eigvals(matrix).astype(complex))


def _intervals(loop: CascadeController, interval_s: float) -> tuple[int, float]:
    """Split a delay into whole intervals and a rest, s."""
    whole = int(loop.delay_s / interval_s + _WHOLE)
    rest_s = loop.delay_s - whole * interval_s
    return whole, rest_s if rest_s > _WHOLE * interval_s else 0.0


def _law(loop: CascadeController, axis: int, m: int, size: int, interval_s: float) -> FloatArray:
    """Return u_k = law · z_k, (size,)."""
    law = np.zeros(size)
    law[axis] = -loop.kv * loop.kp
    if loop.velocity == "state":
        law[m + axis] = -loop.kv
    else:
        law[axis] -= loop.kv / interval_s
        law[2 * m + axis] = loop.kv / interval_s
    return law


def _input_steps(
    group: Group, axis: int, interval_s: float, late_s: float
) -> tuple[FloatArray, FloatArray]:
    """Return what the newer and the older input (2m,) do within one interval."""
    states, inputs = step_matrices(group, np.array([interval_s - late_s, late_s]))
    return inputs[0][:, axis], states[0] @ inputs[1][:, axis]
