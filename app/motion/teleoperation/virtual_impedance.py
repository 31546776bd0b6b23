"""A virtual mass, damper and spring: parameters, perceived dynamics, and exact response.

    M ẍ + D ẋ + K (x − x0) = F

For a force that is constant over a step dt the solution is exact, so it is stable for every
parameter that is offered and every dt. With σ = D/2M, ω0² = K/M, and the response S of the position
to a unit of impulse on a unit of mass::

    S = e^(−σ dt) sin(ωd dt)/ωd,       ωd² = ω0² − σ²     (sinh where σ > ω0, dt where σ = ω0)
    x' − xe = (Ṡ + 2σ S) (x − xe) + S v,     v' = −ω0² S (x − xe) + Ṡ v,     xe = x0 + F/K

Source: any text on vibration, e.g. L. Meirovitch, *Fundamentals of Vibrations* (2001), ch. 2.
"""

from dataclasses import dataclass, fields
from math import acos, acosh, cos, exp, expm1, inf, isfinite, pi, sin, sqrt
from typing import NamedTuple, Self

from rotemina.app.motion.teleoperation.reference import ScalingError
from rotemina.sim.messages import marked, message
from rotemina.sim.quantities import rounded

_LEAST_DAMPING_RATIO = 0.1  # below it a let-go stick rings for seconds
_MOST_TRAVEL = 1e3  # m or rad, of the spring: beyond, it is none


class Response(NamedTuple):
    """How x − x0 and v after a step follow from those before, and from the force on it."""

    x_of_x: float
    x_of_v: float
    v_of_x: float
    v_of_v: float
    x_of_force: float
    v_of_force: float


@dataclass(frozen=True, slots=True)
class FeltDynamics:
    """What an operator feels of an impedance.

    With a spring: ``natural_frequency_hz``, ``damping_ratio`` and ``travel``, where full deflection
    comes to rest, m or rad. Without: ``terminal_speed`` at full deflection, per s.
    ``time_constant_s`` is that of the slowest part.
    """

    time_constant_s: float
    terminal_speed: float | None = None
    travel: float | None = None
    natural_frequency_hz: float | None = None
    damping_ratio: float | None = None


@dataclass(frozen=True, slots=True)
class VirtualImpedance:
    """M, D, K of one coordinate, and the force z of a full deflection; SI, linear or angular.

    Raises
    ------
    ScalingError
        If a value is not finite; M, D or z is not above 0; K is below 0, or so soft that z reaches
        beyond 1000 m or rad; or the damping ratio is below 0.1.
    """

    mass: float
    damping: float
    stiffness: float
    force: float

    def __post_init__(self) -> None:
        for one in fields(self):
            value = getattr(self, one.name)
            least = (
                marked("engine", "0 or more")
                if one.name == "stiffness"
                else marked("engine", "above 0")
            )
            if not isfinite(value) or value < 0.0 or (value == 0.0 and one.name != "stiffness"):
                raise ScalingError(
                    message("engine", "impedance: {name} {value} must be finite and {least}").fill(
                        name=one.name, value=rounded(value, 6), least=least
                    )
                )
        if not self.stiffness:
            return
        if self.force / self.stiffness > _MOST_TRAVEL:
            raise ScalingError(
                message(
                    "engine",
                    "impedance: with stiffness {stiffness} the force {force} reaches "
                    "{travel} m (or rad), more than {most_travel}; use 0 for no spring",
                ).fill(
                    stiffness=rounded(self.stiffness, 6),
                    force=rounded(self.force, 6),
                    travel=rounded(self.force / self.stiffness, 6),
                    most_travel=_MOST_TRAVEL,
                )
            )
        if self._damping_ratio < _LEAST_DAMPING_RATIO:
            least_damping = 2.0 * _LEAST_DAMPING_RATIO * sqrt(self.stiffness * self.mass)
            raise ScalingError(
                message(
                    "engine",
                    "impedance: damping ratio {damping_ratio} is below "
                    "{least_damping_ratio}, so the axis would ring; use a damping of "
                    "{least_damping} or more",
                ).fill(
                    damping_ratio=rounded(self._damping_ratio, 3),
                    least_damping_ratio=_LEAST_DAMPING_RATIO,
                    least_damping=rounded(least_damping, 6),
                )
            )

    @classmethod
    def gliding(cls, terminal_speed: float, time_constant_s: float) -> Self:
        """Return a mass and a damper: full deflection ends in a speed, reached with a delay."""
        damping = 1.0 / terminal_speed
        return cls(damping * time_constant_s, damping, 0.0, 1.0)

    @classmethod
    def sprung(cls, travel: float, natural_frequency_hz: float, damping_ratio: float) -> Self:
        """Return a mass on a spring: full deflection ends ``travel`` (m or rad) from its rest."""
        stiffness = 1.0 / travel
        rate = 2.0 * pi * natural_frequency_hz
        mass = stiffness / rate**2
        return cls(mass, 2.0 * damping_ratio * rate * mass, stiffness, 1.0)

    @property
    def felt(self) -> FeltDynamics:
        """What an operator feels of it."""
        if not self.stiffness:
            return FeltDynamics(self.mass / self.damping, self.force / self.damping)
        ratio, rate = self._damping_ratio, sqrt(self.stiffness / self.mass)
        slowest = rate * ratio if ratio <= 1.0 else rate / (ratio + sqrt(ratio**2 - 1.0))
        return FeltDynamics(
            1.0 / slowest,
            travel=self.force / self.stiffness,
            natural_frequency_hz=rate / (2.0 * pi),
            damping_ratio=ratio,
        )

    @property
    def acceleration_per_force(self) -> float:
        """The greatest acceleration that forces of up to 1 can make, however they alternate.

        The total variation of the acceleration's step response, which jumps to 1/M and swings
        about 0 with peaks m qⁿ/M::

            (2/M) (1 + m/(1 − q)),  m = e^(−2ζ acos ζ/√(1 − ζ²)),  q = e^(−πζ/√(1 − ζ²))

        with acosh, and q = 0, where ζ > 1; m = 0 without a spring.
        """
        ratio = self._damping_ratio
        if ratio == inf:
            return 2.0 / self.mass
        root = sqrt(abs(1.0 - ratio**2))
        if root < 1e-6:
            return 2.0 / self.mass * (1.0 + exp(-2.0))
        angle, again = (
            (acos(ratio), exp(-pi * ratio / root)) if ratio < 1.0 else (acosh(ratio), 0.0)
        )
        peak = exp(-2.0 * ratio * angle / root)
        return 2.0 / self.mass * (1.0 + peak / (1.0 - again))

    def response(self, dt: float) -> Response:
        """Return the exact response after ``dt`` s to a force that is constant meanwhile."""
        impulse, slope = self._impulse(dt)
        sigma = self.damping / (2.0 * self.mass)
        square = self.stiffness / self.mass
        kept = slope + 2.0 * sigma * impulse
        if self.stiffness:
            x_of_force = (1.0 - kept) / self.stiffness
        else:
            x_of_force = (dt - impulse) / self.damping
        return Response(kept, impulse, -square * impulse, slope, x_of_force, impulse / self.mass)

    @property
    def _damping_ratio(self) -> float:
        if not self.stiffness:
            return inf
        return self.damping / (2.0 * sqrt(self.stiffness * self.mass))

    def _impulse(self, dt: float) -> tuple[float, float]:
        """Return S and Ṡ."""
        sigma = self.damping / (2.0 * self.mass)
        square = self.stiffness / self.mass
        over = sigma**2 - square
        if over > 0.0:
            root = sqrt(over)
            slow = exp(-square / (sigma + root) * dt)
            fast = exp(-(sigma + root) * dt)
            # S = (slow − fast)/(2 root), without the difference of what is almost equal.
            impulse = -slow * expm1(-2.0 * root * dt) / (2.0 * root)
            return impulse, 0.5 * (slow + fast) - sigma * impulse
        root, decay = sqrt(-over), exp(-sigma * dt)
        impulse = decay * (sin(root * dt) / root if root > 0.0 else dt)
        return impulse, decay * cos(root * dt) - sigma * impulse
