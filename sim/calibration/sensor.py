"""The model of a sensor: its reading at each position of the axis.

    y = o + (1 + e) q̃ + (1 − ξ²) Σ b_k ξ^k + Σ w_j E_j(q̃) + S₁ sin φ + C₁ cos φ + S₂ … + C₂ …

Here q̃ is the position after the lag, ξ = −1 … 1 over the range, and ``φ = 2π q̃/p``. So offset and
gain belong to the line through both ends of the range, and the bend is the terminal-based
nonlinearity. ``E_j`` are stop operators (:mod:`rotemina.sim.compensate.prandtl_ishlinskii`).
"""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.sensor_lag import SensorLag

# Radii of the stop operators, as shares of the range.
STOP_RADIUS_SHARES = (0.0005, 0.002, 0.01, 0.04, 0.15)
# Values of ξ at which the bend is evaluated to find its maximum.
BEND_PLACES = np.linspace(-1.0, 1.0, 401)
# Largest number of coefficients b_k.
MAX_BEND_COEFFICIENTS = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class SensorModel:
    """Model of a sensor and its errors, in SI units.

    Attributes
    ----------
    low, high : range over which ξ runs, m or rad.
    offset : offset o, m or rad.
    gain_error : relative gain error e.
    bend : coefficients b_k from k = 0 on, m or rad.
    radii, weights : radii, m or rad, and weights w_j of the stops.
    lag, lag_s : kind of the lag, and its time T.
    period : period p of an encoder's interpolation error, m or rad; 0 for none.
    harmonics : S₁, C₁, S₂, C₂, m or rad.
    """

    low: float
    high: float
    offset: float = 0.0
    gain_error: float = 0.0
    bend: tuple[float, ...] = ()
    radii: tuple[float, ...] = ()
    weights: tuple[float, ...] = ()
    lag: SensorLag = SensorLag.NONE
    lag_s: float = 0.0
    period: float = 0.0
    harmonics: tuple[float, ...] = ()

    def normalise_position(self, position: FloatArray) -> FloatArray:
        """Return the normalised positions ξ (n,), −1 … 1 over the range."""
        return np.asarray((2.0 * position - self.low - self.high) / (self.high - self.low))

    def compute_bend(self, place: FloatArray) -> FloatArray:
        """Return the bend (n,) at ξ, m or rad, for a model that has one."""
        curve = np.polynomial.polynomial.polyval(place, self.bend)
        return np.asarray((1.0 - place**2) * curve)

    def compute_position_error(self, position: FloatArray) -> FloatArray:
        """Return the error (n,) of bend and interpolation, m or rad."""
        error = np.zeros_like(position)
        if self.bend:
            error += self.compute_bend(self.normalise_position(position))
        if self.period:
            error += compute_waves(position, self.period) @ np.array(self.harmonics)
        return error

    @property
    def hysteresis(self) -> float:
        """Width of the loop over a long travel, m or rad."""
        return 2.0 * float(np.dot(self.radii, self.weights)) if self.radii else 0.0

    @property
    def nonlinearity(self) -> float:
        """Largest absolute bend over the range, m or rad."""
        return float(np.abs(self.compute_bend(BEND_PLACES)).max()) if self.bend else 0.0

    @property
    def interpolation(self) -> float:
        """Largest absolute interpolation error of the encoder, m or rad."""
        if not self.period:
            return 0.0
        one_period = np.linspace(0.0, self.period, 200)
        return float(
            np.abs(compute_waves(one_period, self.period) @ np.array(self.harmonics)).max()
        )


def compute_waves(position: FloatArray, period: float) -> FloatArray:
    """Return sin φ, cos φ, sin 2φ, cos 2φ (n, 4)."""
    phase = 2.0 * np.pi * position / period
    return np.stack([np.sin(phase), np.cos(phase), np.sin(2 * phase), np.cos(2 * phase)], axis=1)
