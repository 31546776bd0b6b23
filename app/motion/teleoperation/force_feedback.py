"""Contact force feedback: a force on the virtual mass, limited so that the mechanism stays passive.

The contact signal s is the deviation of the real position from that of the model (m or rad), or the
force on the tip (N). It is negative if the contact pushes back against positive motion. The force
is s times a gain g, with a soft dead band for noise, and limited to a maximum::

    R = clip(g (|s| − noise)⁺ sgn s, ±max_force)

**Passivity.** The contact itself is a monotonic function of the current position and returns no
more energy than it received. The reading that is fed back is older: it is d seconds old when a step
of T seconds begins, and it is held during the step. With the slope k = g · |∂s/∂x|, the force that
is fed back differs from the current one by at most k ∫|v| over this age. Because of
|v v'| ≤ (v² + v'²)/2, this adds at most the energy ``k (d + T/2) ∫ v² dt``. The damper dissipates
``D ∫ v² dt``. So the mechanism stays passive if::

    g · |∂s/∂x| · (d + T/2) ≤ D

For d = 0 this is the bound of J. E. Colgate and G. G. Schenkel, *J. Robotic Systems* 14 (1997) 37,
for a virtual wall without damping.
"""

from dataclasses import dataclass
from math import copysign, isfinite

from rotemina.app.errors import ScalingError
from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance
from rotemina.sim.messages import format_rounded


@dataclass(frozen=True, slots=True)
class ContactFeedback:
    """Gain and bounds with which a contact is fed back to the virtual mass.

    Attributes
    ----------
    gain : float
        Force on the virtual mass per unit of the contact signal: N/m for a deviation, N/N for a
        force.
    noise : float
        Dead band of the contact signal, m (rad) or N. It must cover the noise of a free tip.
    max_force : float
        Maximum force on the virtual mass, N.
    slope : float
        Change of the contact signal per metre (or radian) of motion into the contact: 1 for a
        deviation, the stiffness of the contact in N/m for a force.
    max_step_s, delay_s : float
        Longest step of the law, and maximum age of the reading when the step begins.

    Raises
    ------
    ScalingError
        If a value is not finite or below 0, or the slope or a time is 0.
    """

    gain: float
    noise: float
    max_force: float
    slope: float = 1.0
    max_step_s: float = 0.01
    delay_s: float = 0.01

    def __post_init__(self) -> None:
        values = self.gain, self.noise, self.max_force, self.slope, self.max_step_s, self.delay_s
        if not all(map(isfinite, values)) or min(values) < 0.0 or min(values[3:5]) == 0.0:
            raise ScalingError(
                "contact: gain {gain}, noise {noise}, greatest force {most}, slope {slope}, "
                "step {longest_step_s} s, delay {delay_s} s: all must be finite and not below "
                "0, slope and step above 0",
                gain=self.gain,
                noise=self.noise,
                most=self.max_force,
                slope=self.slope,
                longest_step_s=self.max_step_s,
                delay_s=self.delay_s,
            )

    def compute_force(self, contact_signal: float) -> float:
        """Return the force on the virtual mass for a contact signal, N."""
        magnitude = self.gain * max(abs(contact_signal) - self.noise, 0.0)
        return copysign(min(magnitude, self.max_force), contact_signal)

    def compute_max_gain(self, impedance: VirtualImpedance) -> float:
        """Return the highest gain with which an impedance stays passive."""
        return impedance.damping / (self.slope * (self.delay_s + 0.5 * self.max_step_s))

    def check_passivity(self, impedance: VirtualImpedance) -> None:
        """Refuse a gain with which an impedance might release more energy than it received.

        Raises
        ------
        ScalingError
            If the gain is too high. The message names the highest permitted gain.
        """
        max_gain = self.compute_max_gain(impedance)
        if self.gain > max_gain * (1.0 + 1e-9):
            raise ScalingError(
                "contact: with gain {gain} the stick's mechanism might release more "
                "energy than it received: at most {most} is permitted with a damping of "
                "{damping} N s/m and readings {delay_s} ms old; lower the gain or raise "
                "the damping",
                gain=format_rounded(self.gain, 6),
                most=format_rounded(max_gain, 6),
                damping=format_rounded(impedance.damping, 6),
                delay_s=format_rounded(1000.0 * self.delay_s, 3),
            )
