"""A virtual mass, damper and spring: parameters, perceived dynamics and exact response.

    M ẍ + D ẋ + K (x − x0) = F

The solution is exact for a force that is constant over a step dt. So it is stable for all permitted
parameters and any dt. Let σ = D/2M and ω0² = K/M, and let S be the position response of a unit mass
to a unit impulse. Then::

    S = e^(−σ dt) sin(ωd dt)/ωd,       ωd² = ω0² − σ²     (sinh where σ > ω0, dt where σ = ω0)
    x' − xe = (Ṡ + 2σ S) (x − xe) + S v,     v' = −ω0² S (x − xe) + Ṡ v,     xe = x0 + F/K

Source: any text on vibration, e.g. L. Meirovitch, *Fundamentals of Vibrations* (2001), ch. 2.
"""

from dataclasses import dataclass, fields
from math import acos, acosh, cos, exp, expm1, inf, isfinite, pi, sin, sqrt
from typing import NamedTuple, Self

from rotemina.app.errors import ScalingError
from rotemina.sim.messages import format_rounded, marked

# With a lower damping ratio the mechanism would ring for seconds after the stick is released.
_MIN_DAMPING_RATIO = 0.1
# A spring that permits a longer travel, in m or rad, is too soft to have an effect.
_MAX_SPRING_TRAVEL = 1e3


class ImpedanceResponse(NamedTuple):
    """Coefficients of the response after a step.

    They give x − x0 and v after the step from x − x0, v and the force before the step.
    """

    x_of_x: float
    x_of_v: float
    v_of_x: float
    v_of_v: float
    x_of_force: float
    v_of_force: float


@dataclass(frozen=True, slots=True)
class PerceivedDynamics:
    """Dynamics of an impedance as the operator perceives them.

    Attributes
    ----------
    time_constant_s : float
        Time constant of the slowest mode.
    terminal_speed : float or None
        Final speed at full deflection, m/s or rad/s; only without a spring.
    travel : float or None
        Distance from the rest position at full deflection, m or rad; only with a spring.
    natural_frequency_hz, damping_ratio : float or None
        Properties of the oscillation; only with a spring.
    """

    time_constant_s: float
    terminal_speed: float | None = None
    travel: float | None = None
    natural_frequency_hz: float | None = None
    damping_ratio: float | None = None


@dataclass(frozen=True, slots=True)
class VirtualImpedance:
    """Parameters M, D and K of one coordinate, and the force z at full deflection, in SI units.

    The coordinate may be linear or angular.

    Raises
    ------
    ScalingError
        If a value is not finite, M, D or z is not above 0, or K is below 0. Also if there is a
        spring that z moves by more than 1000 m or rad, or whose damping ratio is below 0.1.
    """

    mass: float
    damping: float
    stiffness: float
    force: float

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            bound = (
                marked("engine", "0 or more")
                if field.name == "stiffness"
                else marked("engine", "above 0")
            )
            if not isfinite(value) or value < 0.0 or (value == 0.0 and field.name != "stiffness"):
                raise ScalingError(
                    "impedance: {name} {value} must be finite and {least}",
                    name=field.name,
                    value=format_rounded(value, 6),
                    least=bound,
                )
        if not self.stiffness:
            return
        if self.force / self.stiffness > _MAX_SPRING_TRAVEL:
            raise ScalingError(
                "impedance: with stiffness {stiffness} the force {force} reaches "
                "{travel} m (or rad), more than {most_travel}; use 0 for no spring",
                stiffness=format_rounded(self.stiffness, 6),
                force=format_rounded(self.force, 6),
                travel=format_rounded(self.force / self.stiffness, 6),
                most_travel=_MAX_SPRING_TRAVEL,
            )
        if self._damping_ratio < _MIN_DAMPING_RATIO:
            min_damping = 2.0 * _MIN_DAMPING_RATIO * sqrt(self.stiffness * self.mass)
            raise ScalingError(
                "impedance: damping ratio {damping_ratio} is below "
                "{least_damping_ratio}, so the axis would ring; use a damping of "
                "{least_damping} or more",
                damping_ratio=format_rounded(self._damping_ratio, 3),
                least_damping_ratio=_MIN_DAMPING_RATIO,
                least_damping=format_rounded(min_damping, 6),
            )

    @classmethod
    def make_gliding(cls, terminal_speed: float, time_constant_s: float) -> Self:
        """Return a mass and a damper that reach a terminal speed at full deflection."""
        damping = 1.0 / terminal_speed
        return cls(damping * time_constant_s, damping, 0.0, 1.0)

    @classmethod
    def make_sprung(cls, travel: float, natural_frequency_hz: float, damping_ratio: float) -> Self:
        """Return a mass on a spring that full deflection moves by ``travel``, m or rad."""
        stiffness = 1.0 / travel
        rate = 2.0 * pi * natural_frequency_hz
        mass = stiffness / rate**2
        return cls(mass, 2.0 * damping_ratio * rate * mass, stiffness, 1.0)

    @property
    def perceived_dynamics(self) -> PerceivedDynamics:
        """The dynamics as the operator perceives them."""
        if not self.stiffness:
            return PerceivedDynamics(self.mass / self.damping, self.force / self.damping)
        ratio, rate = self._damping_ratio, sqrt(self.stiffness / self.mass)
        slowest_rate = rate * ratio if ratio <= 1.0 else rate / (ratio + sqrt(ratio**2 - 1.0))
        return PerceivedDynamics(
            1.0 / slowest_rate,
            travel=self.force / self.stiffness,
            natural_frequency_hz=rate / (2.0 * pi),
            damping_ratio=ratio,
        )

    @property
    def max_acceleration_per_force(self) -> float:
        """Largest acceleration that any sequence of forces with magnitudes up to 1 can cause.

        It is the total variation of the step response of the acceleration, which jumps to 1/M and
        then oscillates about 0 with peaks m qⁿ/M::

            (2/M) (1 + m/(1 − q)),  m = e^(−2ζ acos ζ/√(1 − ζ²)),  q = e^(−πζ/√(1 − ζ²))

        For ζ > 1, acosh replaces acos, and q = 0. Without a spring, m = 0.
        """
        ratio = self._damping_ratio
        if ratio == inf:
            return 2.0 / self.mass
        root = sqrt(abs(1.0 - ratio**2))
        if root < 1e-6:
            return 2.0 / self.mass * (1.0 + exp(-2.0))
        angle, decay = (
            (acos(ratio), exp(-pi * ratio / root)) if ratio < 1.0 else (acosh(ratio), 0.0)
        )
        peak = exp(-2.0 * ratio * angle / root)
        return 2.0 / self.mass * (1.0 + peak / (1.0 - decay))

    def compute_response(self, dt: float) -> ImpedanceResponse:
        """Return the exact response after ``dt`` s to a constant force."""
        impulse, slope = self._compute_impulse_response(dt)
        sigma = self.damping / (2.0 * self.mass)
        omega_squared = self.stiffness / self.mass
        x_of_x = slope + 2.0 * sigma * impulse
        if self.stiffness:
            x_of_force = (1.0 - x_of_x) / self.stiffness
        else:
            x_of_force = (dt - impulse) / self.damping
        return ImpedanceResponse(
            x_of_x, impulse, -omega_squared * impulse, slope, x_of_force, impulse / self.mass
        )

    @property
    def _damping_ratio(self) -> float:
        if not self.stiffness:
            return inf
        return self.damping / (2.0 * sqrt(self.stiffness * self.mass))

    def _compute_impulse_response(self, dt: float) -> tuple[float, float]:
        """Return S and Ṡ."""
        sigma = self.damping / (2.0 * self.mass)
        omega_squared = self.stiffness / self.mass
        discriminant = sigma**2 - omega_squared
        if discriminant > 0.0:
            root = sqrt(discriminant)
            slow = exp(-omega_squared / (sigma + root) * dt)
            fast = exp(-(sigma + root) * dt)
            # S = (slow − fast)/(2 root), without the difference of two almost equal numbers.
            impulse = -slow * expm1(-2.0 * root * dt) / (2.0 * root)
            return impulse, 0.5 * (slow + fast) - sigma * impulse
        root, decay = sqrt(-discriminant), exp(-sigma * dt)
        impulse = decay * (sin(root * dt) / root if root > 0.0 else dt)
        return impulse, decay * cos(root * dt) - sigma * impulse
