"""Linear laws: a coordinate, or its speed, is proportional to the deflection of the stick.

    x_R = x_0 + α φ          (x_R,i = α_i φ_j,i of the paper, from an anchor x_0)
    ẋ_R = α φ                reached at the maximum acceleration of the coordinate

The anchor is chosen so that the start of a law moves nothing, whatever the deflection. A clutch
works in the same way.
"""

from math import isfinite
from typing import ClassVar

from rotemina.app.errors import ScalingError
from rotemina.app.motion.teleoperation.reference import CoordinateBounds, ReferenceMotion
from rotemina.app.motion.teleoperation.scaling import ScalingLaw


class LinearLaw(ScalingLaw):
    """Law with a scale. A negative scale reverses the direction.

    Parameters
    ----------
    bounds : CoordinateBounds
    scale : float
        α, the distance or speed at full deflection.

    Raises
    ------
    ScalingError
        If the scale is not finite, or 0.
    """

    name: ClassVar[str]

    def __init__(self, bounds: CoordinateBounds, scale: float) -> None:
        super().__init__(bounds)
        if not isfinite(scale) or scale == 0.0:
            raise ScalingError(
                "{what}: scale {scale} must be finite and not 0", what=self.name, scale=scale
            )
        self.scale = scale

    @property
    def _scaled_deflection(self) -> float:
        return self.factor * self.scale * self._deflection


class LinearPositionLaw(LinearLaw):
    """Law in which the deflection sets a target, which the coordinate follows without overshoot.

    The scale is a distance, m or rad.
    """

    name = "linear position"

    def __init__(self, bounds: CoordinateBounds, scale: float) -> None:
        super().__init__(bounds, scale)
        self._origin = self._motion.position

    @property
    def target(self) -> float:
        """Target that the stick sets, clipped to the range."""
        return self.bounds.clip(self._origin + self._scaled_deflection)

    def _set_anchor(self) -> None:
        # The target is where the current motion can stop, so that it does not reverse.
        self._origin = self.bounds.find_stopping_position(self._motion) - self._scaled_deflection

    def _step(self, dt: float, reaction: float) -> ReferenceMotion:
        return self.bounds.step_toward(self._motion, self.target, dt)

    def _rescale(self, factor: float) -> None:
        self._origin += self._scaled_deflection * (1.0 - factor / self.factor)


class LinearRateLaw(LinearLaw):
    """Law in which the deflection sets the speed; with the stick centred the coordinate halts.

    The scale is a speed, m/s or rad/s.
    """

    name = "linear rate"

    def _set_anchor(self) -> None:
        """Do nothing, because a speed has no anchor."""

    def _step(self, dt: float, reaction: float) -> ReferenceMotion:
        return self.bounds.step_at_speed(self._motion, self._scaled_deflection, dt)

    def _rescale(self, factor: float) -> None:
        """Do nothing, because the acceleration bound makes the change smooth."""
