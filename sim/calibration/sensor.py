"""The model of a sensor: its reading at each position of the axis.

    y = o + (1 + e) q̃ + (1 − ξ²) Σ b_k ξ^k + Σ w_j E_j(q̃) + S₁ sin φ + C₁ cos φ + S₂ … + C₂ …

of the position q̃ that came through the lag; ξ = −1 … 1 over the range, ``φ = 2π q̃/p``. So offset
and gain are those of the line through both ends of the range, and the bend is the terminal-based
nonlinearity. ``E_j`` are stop operators (:mod:`rotemina.sim.stops`).
"""

from dataclasses import dataclass

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.calibration.sensor_lag import Lag

SHARES = (0.0005, 0.002, 0.01, 0.04, 0.15)  # of the range: radii of the stops
PLACES = np.linspace(-1.0, 1.0, 401)  # ξ at which the greatest bend is looked for
BENDS = 6  # coefficients of the bend at the most


@dataclass(frozen=True, slots=True, kw_only=True)
class SensorModel:
    """A sensor with its errors, SI.

    Attributes
    ----------
    low, high : the range over which ξ runs, m or rad.
    offset : o, m or rad.
    gain_error : e.
    bend : b_k from k = 0 on, m or rad.
    radii, weights : of the stops, r in m or rad.
    lag, lag_s : its kind, and T.
    period : p of an encoder's interpolation error, m or rad; 0: none.
    harmonics : S₁, C₁, S₂, C₂, m or rad.
    """

    low: float
    high: float
    offset: float = 0.0
    gain_error: float = 0.0
    bend: tuple[float, ...] = ()
    radii: tuple[float, ...] = ()
    weights: tuple[float, ...] = ()
    lag: Lag = Lag.NONE
    lag_s: float = 0.0
    period: float = 0.0
    harmonics: tuple[float, ...] = ()

    def place(self, position: FloatArray) -> FloatArray:
        """Return ξ."""
        return np.asarray((2.0 * position - self.low - self.high) / (self.high - self.low))

    def bend_at(self, place: FloatArray) -> FloatArray:
        """Return the bend (n,) at ξ, m or rad; there must be one."""
        curve = np.polynomial.polynomial.polyval(place, self.bend)
        return np.asarray((1.0 - place**2) * curve)

    def bent(self, position: FloatArray) -> FloatArray:
        """Return the error (n,) of bend and interpolation, m or rad."""
        error = np.zeros_like(position)
        if self.bend:
            error += self.bend_at(self.place(position))
        if self.period:
            error += waves(position, self.period) @ np.array(self.harmonics)
        return error

    @property
    def hysteresis(self) -> float:
        """Width of the loop over a long travel, m or rad."""
        return 2.0 * float(np.dot(self.radii, self.weights)) if self.radii else 0.0

    @property
    def nonlinearity(self) -> float:
        """Greatest bend over the range, m or rad."""
        return float(np.abs(self.bend_at(PLACES)).max()) if self.bend else 0.0

    @property
    def interpolation(self) -> float:
        """Greatest error of the encoder's interpolation, m or rad."""
        if not self.period:
            return 0.0
        within = np.linspace(0.0, self.period, 200)
        return float(np.abs(waves(within, self.period) @ np.array(self.harmonics)).max())


def waves(position: FloatArray, period: float) -> FloatArray:
    """Return sin φ, cos φ, sin 2φ, cos 2φ (n, 4)."""
    phase = 2.0 * np.pi * position / period
    return np.stack([np.sin(phase), np.cos(phase), np.sin(2 * phase), np.cos(2 * phase)], axis=1)
