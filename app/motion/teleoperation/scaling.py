"""Base of the scaling laws, which turn the deflection of a stick into motion of a coordinate.

The laws are in :mod:`~rotemina.app.motion.teleoperation.linear_laws` and ``impedance``. Each
coordinate has its own law object. To change the law, start the new one with the motion of the old
one.
"""

from abc import ABC, abstractmethod
from math import isfinite
from typing import final

from rotemina.app.errors import ScalingError
from rotemina.app.motion.teleoperation.reference import CoordinateBounds, ReferenceMotion

FINE_FACTOR, COARSE_FACTOR = 0.1, 10.0
#: Factors by which the operator can multiply the scale of a law.
STEP_PRESETS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)


def find_next_preset(factor: float) -> float:
    """Return the next larger factor of :data:`STEP_PRESETS`, or the smallest after the largest."""
    return next(
        (preset for preset in STEP_PRESETS if preset > factor * (1.0 + 1e-9)), STEP_PRESETS[0]
    )


class ScalingLaw(ABC):
    """Law that turns a stick's deflection into the motion of one coordinate.

    The motion begins at rest in the middle of the range, and stays within the limits for any input.
    The position does not jump at a start, a change of scale or a hold.

    Parameters
    ----------
    bounds : CoordinateBounds
        Limits of the coordinate.
    """

    def __init__(self, bounds: CoordinateBounds) -> None:
        self.bounds = bounds
        self._motion = ReferenceMotion(0.5 * (bounds.low + bounds.high), 0.0)
        self._deflection = 0.0
        self._factor = 1.0

    @property
    def motion(self) -> ReferenceMotion:
        """Current position and velocity of the reference."""
        return self._motion

    @property
    def factor(self) -> float:
        """Factor by which fine, coarse and the step preset multiply the scale of the law."""
        return self._factor

    @final
    def start(self, position: float, velocity: float, deflection: float) -> ReferenceMotion:
        """Continue from a motion with the stick at a deflection, for example after a clutch.

        A position outside the range is moved to the nearest end. A speed from which the motion
        could not stop inside the range is reduced.
        """
        self._motion = self.bounds.limit_motion(position, velocity)
        self._deflection = _clip_deflection(deflection)
        self._set_anchor()
        return self._motion

    @final
    def step(self, deflection: float, dt: float, reaction: float = 0.0) -> ReferenceMotion:
        """Advance by ``dt`` s with a deflection of −1 to 1; a ``dt`` of 0 changes nothing.

        ``reaction`` is the contact signal. Only the impedance law uses it.

        Raises
        ------
        ScalingError
            If an argument is not finite, or ``dt`` is negative.
        """
        if not (isfinite(dt) and isfinite(reaction)) or dt < 0.0:
            raise ScalingError(
                "scaling: step of {dt} s with a reaction of {reaction}: both must be "
                "finite, the step 0 or more",
                dt=dt,
                reaction=reaction,
            )
        self._deflection = _clip_deflection(deflection)
        if dt > 0.0:
            self._motion = self._step(dt, reaction)
        return self._motion

    @final
    def hold_at(self, position: float, velocity: float = 0.0) -> ReferenceMotion:
        """Set the reference back to the position of the machine, so that it does not run ahead."""
        self._motion = self.bounds.limit_motion(position, velocity)
        return self._motion

    @final
    def rescale(self, factor: float) -> None:
        """Multiply the scale of the law by a factor, also during a motion.

        Raises
        ------
        ScalingError
            If the factor is not finite or not above 0.
        """
        if not isfinite(factor) or factor <= 0.0:
            raise ScalingError("scaling: factor {factor} must be finite and above 0", factor=factor)
        self._rescale(factor)
        self._factor = factor

    @abstractmethod
    def _set_anchor(self) -> None:
        pass

    @abstractmethod
    def _step(self, dt: float, reaction: float) -> ReferenceMotion:
        pass

    @abstractmethod
    def _rescale(self, factor: float) -> None:
        """Prepare for another factor; ``self.factor`` is still the previous one."""


def _clip_deflection(value: float) -> float:
    if not isfinite(value):
        raise ScalingError("scaling: the deflection {value} is not a finite number", value=value)
    return min(max(value, -1.0), 1.0)
