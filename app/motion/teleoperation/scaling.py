"""Scaling of a stick's deflection to the motion of a coordinate: the base of all scaling laws.

The laws: :mod:`~rotemina.app.motion.teleoperation.linear_laws` and ``impedance``, one instance for
each degree of freedom. A law is switched by starting the new one with the old one's motion.
"""

from abc import ABC, abstractmethod
from math import isfinite
from typing import final

from rotemina.app.motion.teleoperation.reference import Bounds, Motion, ScalingError
from rotemina.sim.messages import message

FINE, COARSE = 0.1, 10.0
#: Factors on a law's own scale that an operator steps through.
STEP_PRESETS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)


def next_preset(factor: float) -> float:
    """Return the next greater factor of :data:`STEP_PRESETS`, the least after the greatest."""
    return next((one for one in STEP_PRESETS if one > factor * (1.0 + 1e-9)), STEP_PRESETS[0])


class ScalingLaw(ABC):
    """The motion that a stick makes of one coordinate; it begins at rest at the range's middle.

    Whatever comes in, the motion keeps to the bounds, and starting, switching of scale and holding
    make no step in position.

    Parameters
    ----------
    bounds : Bounds
        Of the coordinate.
    """

    def __init__(self, bounds: Bounds) -> None:
        self.bounds = bounds
        self._motion = Motion(0.5 * (bounds.low + bounds.high), 0.0)
        self._deflection = 0.0
        self._factor = 1.0

    @property
    def motion(self) -> Motion:
        """Where the reference is and how fast it goes."""
        return self._motion

    @property
    def factor(self) -> float:
        """The factor on the law's own scale: fine, coarse, or a step preset."""
        return self._factor

    @final
    def start(self, position: float, velocity: float, deflection: float) -> Motion:
        """Continue from a motion, with the stick where it is; also re-indexes after a clutch.

        A position outside the range counts as its end, a speed that could not be braked in the
        range is reduced.
        """
        self._motion = self.bounds.begin(position, velocity)
        self._deflection = _deflection(deflection)
        self._anchor()
        return self._motion

    @final
    def step(self, deflection: float, dt: float, reaction: float = 0.0) -> Motion:
        """Advance by ``dt`` s with a deflection of −1 to 1; a dt of 0 leaves all as it is.

        ``reaction`` is what a contact is felt by; only the impedance law heeds it.

        Raises
        ------
        ScalingError
            If deflection or reaction is not finite, or dt is not, or below 0.
        """
        if not (isfinite(dt) and isfinite(reaction)) or dt < 0.0:
            raise ScalingError(
                message(
                    "engine",
                    "scaling: step of {dt} s with a reaction of {reaction}: both must be "
                    "finite, the step 0 or more",
                ).fill(dt=dt, reaction=reaction)
            )
        self._deflection = _deflection(deflection)
        if dt > 0.0:
            self._motion = self._step(dt, reaction)
        return self._motion

    @final
    def hold(self, position: float, velocity: float = 0.0) -> Motion:
        """Note that the machine is only there: the reference does not run ahead of it."""
        self._motion = self.bounds.begin(position, velocity)
        return self._motion

    @final
    def rescale(self, factor: float) -> None:
        """Multiply the law's own scale by a factor, also in mid-move.

        Raises
        ------
        ScalingError
            If the factor is not finite or not above 0.
        """
        if not isfinite(factor) or factor <= 0.0:
            raise ScalingError(
                message("engine", "scaling: factor {factor} must be finite and above 0").fill(
                    factor=factor
                )
            )
        self._rescale(factor)
        self._factor = factor

    @abstractmethod
    def _anchor(self) -> None:
        """Index again, for the present motion and deflection."""

    @abstractmethod
    def _step(self, dt: float, reaction: float) -> Motion:
        """Return the motion after ``dt``."""

    @abstractmethod
    def _rescale(self, factor: float) -> None:
        """Prepare for another factor; ``factor`` still is the old one."""


def _deflection(value: float) -> float:
    if not isfinite(value):
        raise ScalingError(
            message("engine", "scaling: the deflection {value} is not a finite number").fill(
                value=value
            )
        )
    return min(max(value, -1.0), 1.0)
