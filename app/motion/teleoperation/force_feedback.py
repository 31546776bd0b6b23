"""The contact force at the stick: a force on the virtual mass, bounded to stay passive.

A contact is told by the deviation of the real position from the model's (m or rad), or by the force
on the tip (N), either below 0 where it pushes back against positive motion. A gain g makes a force
of it, with a soft dead band for what is noise, and a greatest force::

    R = clip(g (|s| − noise)⁺ sgn s, ±most)

**Passivity.** The contact itself, a monotone function of the present position, gives no more energy
than it took. What is fed in is older: known for d s when a step of T s begins, and held over it.
With the slope k = g · |∂s/∂x| it differs from the present one by at most k ∫|v| over that age, so
that, by |v v'| ≤ (v² + v'²)/2, it adds at most ``k (d + T/2) ∫ v² dt``. The damper takes
``D ∫ v² dt``. Hence the mechanism stays passive if::

    g · |∂s/∂x| · (d + T/2) ≤ D

(for d = 0 the bound of J. E. Colgate and G. G. Schenkel, *J. Robotic Systems* 14 (1997) 37, for a
virtual wall without a damper of its own).
"""

from dataclasses import dataclass
from math import copysign, isfinite

from rotemina.app.motion.teleoperation.reference import ScalingError
from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded


@dataclass(frozen=True, slots=True)
class Contact:
    """How a contact is reflected.

    Attributes
    ----------
    gain : float
        Force on the virtual mass per unit of what tells of the contact: N/m of deviation, or N/N.
    noise : float
        Dead band of what tells of it, m (rad) or N: at least what it strays without a contact.
    most : float
        Greatest force on the virtual mass, N.
    slope : float
        How much of what tells of it comes with each metre (or radian) of motion into the contact:
        1 of a deviation, the contact's stiffness in N/m of a force.
    longest_step_s, delay_s : float
        The longest step of the law; how old the reading may be at the step's beginning.

    Raises
    ------
    ScalingError
        If a value is not finite or below 0, or the slope or a time is 0.
    """

    gain: float
    noise: float
    most: float
    slope: float = 1.0
    longest_step_s: float = 0.01
    delay_s: float = 0.01

    def __post_init__(self) -> None:
        values = self.gain, self.noise, self.most, self.slope, self.longest_step_s, self.delay_s
        if not all(map(isfinite, values)) or min(values) < 0.0 or min(values[3:5]) == 0.0:
            raise ScalingError(
                message(
                    "engine",
                    "contact: gain {gain}, noise {noise}, greatest force {most}, slope {slope}, "
                    "step {longest_step_s} s, delay {delay_s} s: all must be finite and not below "
                    "0, slope and step above 0",
                ).fill(
                    gain=self.gain,
                    noise=self.noise,
                    most=self.most,
                    slope=self.slope,
                    longest_step_s=self.longest_step_s,
                    delay_s=self.delay_s,
                )
            )

    def force(self, sensed: float) -> float:
        """Return the force on the virtual mass, N."""
        size = self.gain * max(abs(sensed) - self.noise, 0.0)
        return copysign(min(size, self.most), sensed)

    def greatest_gain(self, impedance: VirtualImpedance) -> float:
        """Return the greatest gain at which an impedance stays passive."""
        return impedance.damping / (self.slope * (self.delay_s + 0.5 * self.longest_step_s))

    def check(self, impedance: VirtualImpedance) -> None:
        """Refuse a gain at which an impedance might give more energy than it was given.

        Raises
        ------
        ScalingError
            With the greatest gain that is allowed.
        """
        most = self.greatest_gain(impedance)
        if self.gain > most * (1.0 + 1e-9):
            raise ScalingError(
                message(
                    "engine",
                    "contact: with gain {gain} the stick's mechanism might release more "
                    "energy than it received: at most {most} is permitted with a damping of "
                    "{damping} N s/m and readings {delay_s} ms old; lower the gain or raise "
                    "the damping",
                ).fill(
                    gain=rounded(self.gain, 6),
                    most=rounded(most, 6),
                    damping=rounded(impedance.damping, 6),
                    delay_s=rounded(1000.0 * self.delay_s, 3),
                )
            )
