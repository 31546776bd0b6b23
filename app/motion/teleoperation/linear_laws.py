"""Linear laws: the robot's coordinate, or its speed, is the stick's deflection times a scale.

    x_R = x_0 + α φ          (the paper's x_R,i = α_i φ_j,i, from an anchor x_0)
    ẋ_R = α φ                with the coordinate's greatest acceleration on the way to that speed

The anchor is such that starting moves nothing, whatever the deflection: so a clutch does.
"""

from math import isfinite
from typing import ClassVar

from rotemina.app.motion.teleoperation.reference import Bounds, Motion, ScalingError
from rotemina.app.motion.teleoperation.scaling import ScalingLaw
from rotemina.sim.messages import message


class LinearLaw(ScalingLaw):
    """A law with a scale; a negative one turns the direction round.

    Parameters
    ----------
    bounds : Bounds
    scale : float
        α, for full deflection.

    Raises
    ------
    ScalingError
        If the scale is not finite, or 0.
    """

    name: ClassVar[str]

    def __init__(self, bounds: Bounds, scale: float) -> None:
        super().__init__(bounds)
        if not isfinite(scale) or scale == 0.0:
            raise ScalingError(
                message("engine", "{what}: scale {scale} must be finite and not 0").fill(
                    what=self.name, scale=scale
                )
            )
        self.scale = scale

    @property
    def _asked(self) -> float:
        return self.factor * self.scale * self._deflection


class LinearPosition(LinearLaw):
    """Follow the stick as fast as the bounds allow, without passing where it points.

    The scale is the way of the coordinate, m or rad.
    """

    name = "linear position"

    def __init__(self, bounds: Bounds, scale: float) -> None:
        super().__init__(bounds, scale)
        self._origin = self._motion.position

    @property
    def target(self) -> float:
        """Where the stick points, inside the range."""
        return self.bounds.clip(self._origin + self._asked)

    def _anchor(self) -> None:
        # A motion under way ends where it can, and does not come back from there.
        self._origin = self.bounds.stopping_place(self._motion) - self._asked

    def _step(self, dt: float, reaction: float) -> Motion:
        return self.bounds.toward(self._motion, self.target, dt)

    def _rescale(self, factor: float) -> None:
        self._origin += self._asked * (1.0 - factor / self.factor)


class LinearRate(LinearLaw):
    """Go at the speed that the stick asks for; in the middle it halts.

    The scale is a speed, m/s or rad/s.
    """

    name = "linear rate"

    def _anchor(self) -> None:
        """Nothing: a speed has no index."""

    def _step(self, dt: float, reaction: float) -> Motion:
        return self.bounds.at_speed(self._motion, self._asked, dt)

    def _rescale(self, factor: float) -> None:
        """Nothing: the acceleration bound makes the change smooth."""
