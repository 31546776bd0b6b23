"""Linear rate: the robot's speed is the stick's deflection times a scale.

ẋ_R = α φ               with the coordinate's greatest acceleration on the way to that speed
"""

from rotemina.app.motion.teleoperation.reference import Bounds, Motion
from rotemina.app.motion.teleoperation.scaling import ScalingLaw, checked_scale


class LinearRate(ScalingLaw):
    """Go at the speed that the stick asks for; in the middle it halts.

    Parameters
    ----------
    bounds : Bounds
    scale : float
        α: speed, m/s or rad/s, at full deflection.

    Raises
    ------
    ScalingError
        If the scale is not finite, or 0.
    """

    def __init__(self, bounds: Bounds, scale: float) -> None:
        super().__init__(bounds)
        self.scale = checked_scale(scale, "linear rate")

    def _anchor(self) -> None:
        """Nothing: a speed has no index."""

    def _step(self, dt: float, reaction: float) -> Motion:
        speed = self.factor * self.scale * self._deflection
        return self.bounds.at_speed(self._motion, speed, dt)

    def _rescale(self, factor: float) -> None:
        """Nothing: the acceleration bound makes the change smooth."""
