"""Does a machine come to rest by itself? A statement per group of coupled axes."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rotemina.sim.arrays import ComplexArray
from rotemina.sim.modes.vibration import poles_of
from rotemina.sim.robot.model import Robot

# A real part smaller than this share of the largest pole is told from zero by rounding alone.
_ON_AXIS_SHARE = 1e-10


class Verdict(StrEnum):
    """The fate of a disturbance: it decays, stays, or grows."""

    STABLE = "stable"
    MARGINAL = "marginal"
    UNSTABLE = "unstable"


@dataclass(frozen=True, slots=True, eq=False)
class Stability:
    """Verdict on one group of coupled axes driven open loop.

    Attributes
    ----------
    axes : tuple of str, length m
    verdict : Verdict
    poles : (2m,) complex
        1/s.
    reason : str
        One clause that says which poles decide.
    """

    axes: tuple[str, ...]
    verdict: Verdict
    poles: ComplexArray
    reason: str

    @property
    def message(self) -> str:
        """The verdict with its reason, for a person."""
        return f"{' '.join(self.axes)}: {self.verdict}; {self.reason}"


def stability(robot: Robot) -> tuple[Stability, ...]:
    """Judge every group of coupled axes of ``robot`` by its poles; static axes have none."""
    return tuple(_judge(axes, poles) for axes, poles in poles_of(robot).items())


def _judge(axes: tuple[str, ...], poles: ComplexArray) -> Stability:
    edge = _ON_AXIS_SHARE * float(np.abs(poles).max())
    fastest = float(poles.real.max())
    free = int((poles == 0.0).sum())
    if fastest > edge:
        reason = f"a pole at {fastest:+.6g} 1/s lies in the right half-plane"
        return Stability(axes, Verdict.UNSTABLE, poles, reason)
    if free:
        return Stability(axes, Verdict.MARGINAL, poles, _free_reason(free))
    if fastest >= -edge:
        hz = float(np.abs(poles[poles.real >= -edge]).min()) / (2.0 * np.pi)
        reason = f"an undamped pair of poles rings at {hz:.6g} Hz for ever"
        return Stability(axes, Verdict.MARGINAL, poles, reason)
    reason = (
        f"all {len(poles)} poles lie in the left half-plane, the slowest decays with "
        f"{-1.0 / fastest:.6g} s"
    )
    return Stability(axes, Verdict.STABLE, poles, reason)


def _free_reason(free: int) -> str:
    if free == 1:
        return "one pole at 0: without stiffness a held force ends in constant speed (integrator)"
    if free == 2:
        return (
            "two poles at 0: with neither stiffness nor damping a held force accelerates for ever "
            "(double integrator)"
        )
    return f"{free} poles at 0: several motions without stiffness"
