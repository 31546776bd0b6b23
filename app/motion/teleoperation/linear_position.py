"""Linear position: the robot's coordinate is the stick's deflection times a scale.

    x_R = x_0 + α φ          (the paper's x_R,i = α_i φ_j,i, from an anchor x_0)

The anchor is such that starting moves nothing, whatever the deflection: so a clutch does.
"""

from rotemina.app.motion.teleoperation.reference import Bounds, Motion
from rotemina.app.motion.teleoperation.scaling import ScalingLaw, checked_scale


class LinearPosition(ScalingLaw):
    """Follow the stick as fast as the bounds allow, without passing where it points.

    Parameters
    ----------
    bounds : Bounds
    scale : float
        α: way of the coordinate, m or rad, for full deflection.

    Raises
    ------
    ScalingError
        If the scale is not finite, or 0.
    """

    def __init__(self, bounds: Bounds, scale: float) -> None:
        super().__init__(bounds)
        self.scale = checked_scale(scale, "linear position")
        self._origin = self._motion.position

    @property
    def target(self) -> float:
        """Where the stick points, inside the range."""
        return self.bounds.clip(self._origin + self._way)

    @property
    def _way(self) -> float:
        return self.factor * self.scale * self._deflection

    def _anchor(self) -> None:
        # A motion under way ends where it can, and does not come back from there.
        self._origin = self.bounds.stopping_place(self._motion) - self._way

    def _step(self, dt: float, reaction: float) -> Motion:
        return self.bounds.toward(self._motion, self.target, dt)

    def _rescale(self, factor: float) -> None:
        self._origin += self._way * (1.0 - factor / self.factor)
