"""Open-loop stability of each group of coupled axes."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rotemina.sim.arrays import ComplexArray
from rotemina.sim.modes.vibration import compute_poles
from rotemina.sim.robot import Robot

# A real part smaller than this share of the largest pole is zero to rounding.
_MIN_REAL_PART_RATIO = 1e-10


class StabilityVerdict(StrEnum):
    """Behaviour of a disturbance: it decays, stays, or grows."""

    STABLE = "stable"
    MARGINAL = "marginal"
    UNSTABLE = "unstable"


@dataclass(frozen=True, slots=True, eq=False)
class OpenLoopStability:
    """Stability of one group of coupled axes in open loop.

    Attributes
    ----------
    axes : tuple of str, length m
    verdict : StabilityVerdict
    poles : (2m,) complex
        1/s.
    reason : str
        Names the poles that decide the verdict.
    """

    axes: tuple[str, ...]
    verdict: StabilityVerdict
    poles: ComplexArray
    reason: str

    @property
    def message(self) -> str:
        """The verdict with its reason, to show to the user."""
        return f"{' '.join(self.axes)}: {self.verdict}; {self.reason}"


def judge_stability(robot: Robot) -> tuple[OpenLoopStability, ...]:
    """Return the stability of every group of coupled axes; static axes have no poles."""
    return tuple(_judge_group(axes, poles) for axes, poles in compute_poles(robot).items())


def _judge_group(axes: tuple[str, ...], poles: ComplexArray) -> OpenLoopStability:
    tolerance = _MIN_REAL_PART_RATIO * float(np.abs(poles).max())
    largest_real_part = float(poles.real.max())
    zero_poles = int((poles == 0.0).sum())
    if largest_real_part > tolerance:
        reason = f"a pole at {largest_real_part:+.6g} 1/s lies in the right half-plane"
        return OpenLoopStability(axes, StabilityVerdict.UNSTABLE, poles, reason)
    if zero_poles:
        return OpenLoopStability(
            axes, StabilityVerdict.MARGINAL, poles, _describe_zero_poles(zero_poles)
        )
    if largest_real_part >= -tolerance:
        frequency_hz = float(np.abs(poles[poles.real >= -tolerance]).min()) / (2.0 * np.pi)
        reason = f"an undamped pair of poles rings at {frequency_hz:.6g} Hz for ever"
        return OpenLoopStability(axes, StabilityVerdict.MARGINAL, poles, reason)
    reason = (
        f"all {len(poles)} poles lie in the left half-plane, the slowest decays with "
        f"{-1.0 / largest_real_part:.6g} s"
    )
    return OpenLoopStability(axes, StabilityVerdict.STABLE, poles, reason)


def _describe_zero_poles(zero_poles: int) -> str:
    if zero_poles == 1:
        return "one pole at 0: without stiffness a held force ends in constant speed (integrator)"
    if zero_poles == 2:
        return (
            "two poles at 0: with neither stiffness nor damping a held force accelerates for ever "
            "(double integrator)"
        )
    return f"{zero_poles} poles at 0: several motions without stiffness"
