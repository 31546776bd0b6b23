"""Impedance: the stick's deflection is a force on a virtual mechanism that the robot follows.

    F = z φ,      M ẍ + D ẋ + K (x − x0) = F + R

(the paper's F_i = z_i φ_j,i), with R what a contact is felt by
(:mod:`rotemina.app.motion.teleoperation.force_feedback`).

**Passivity.** With E = M v²/2 + K (x − x0)²/2, exactly E' − E + losses = (F + R)(x' − x) in each
step. A start or ``hold`` resets E. Bounds of speed and range only take energy. A bound of
acceleration could give some: it makes the mechanism brake later than it would by itself. So M must
be great enough that no alternation of forces reaches it; coarser scales are cut to the force at
which that holds.
"""

from rotemina.app.motion.teleoperation.force_feedback import Contact
from rotemina.app.motion.teleoperation.reference import Bounds, Motion, ScalingError
from rotemina.app.motion.teleoperation.scaling import ScalingLaw
from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance
from rotemina.sim.messages import message
from rotemina.sim.quantities import rounded


class Impedance(ScalingLaw):
    """Push a virtual mechanism, and follow it.

    Parameters
    ----------
    bounds : Bounds
    impedance : VirtualImpedance
    contact : Contact, optional
        How a reaction is felt: that of :meth:`step` is then what tells of the contact, a deviation
        (real less model) or a force on the tip. Without, reactions are not heeded.

    Raises
    ------
    ScalingError
        If the mechanism could accelerate faster than the coordinate may, or the contact could make
        it give energy; with the bound and what to change.
    """

    def __init__(
        self, bounds: Bounds, impedance: VirtualImpedance, contact: Contact | None = None
    ) -> None:
        super().__init__(bounds)
        self.impedance = impedance
        self.contact = contact
        most = bounds.max_acceleration / impedance.acceleration_per_force
        reserved = 0.0
        if contact is not None:
            contact.check(impedance)
            reserved = contact.most
        self._most_force = most - reserved
        if impedance.force > self._most_force * (1.0 + 1e-9):
            reached = (impedance.force + reserved) * impedance.acceleration_per_force
            mass = impedance.mass * reached / bounds.max_acceleration
            raise ScalingError(
                message(
                    "engine",
                    "impedance: forces of up to {force} could accelerate the mass of {mass} "
                    "by {reached} per s², but the axis permits {max_acceleration}; lower the "
                    "force, or use a mass of about {wanted} with the same damping ratio or "
                    "time constant",
                ).fill(
                    force=rounded(impedance.force + reserved, 6),
                    mass=rounded(impedance.mass, 6),
                    reached=rounded(reached, 6),
                    max_acceleration=rounded(bounds.max_acceleration, 6),
                    wanted=rounded(mass, 6),
                )
            )
        #: Where the spring pulls to, x0, m or rad.
        self.rest = self._motion.position

    @property
    def force(self) -> float:
        """The force of the latest deflection."""
        return self._force_per_deflection(self.factor) * self._deflection

    @property
    def acting_factor(self) -> float:
        """The factor that acts: coarser ones are cut to what the acceleration allows."""
        return self._force_per_deflection(self.factor) / self.impedance.force

    def _force_per_deflection(self, factor: float) -> float:
        return min(factor * self.impedance.force, self._most_force)

    def _anchor(self) -> None:
        # In balance with the stick where it is: what begins at rest stays at rest.
        self.rest = self._motion.position
        if self.impedance.stiffness:
            self.rest -= self.force / self.impedance.stiffness

    def _step(self, dt: float, reaction: float) -> Motion:
        pushed = 0.0 if self.contact is None else self.contact.force(reaction)
        after = self.impedance.response(dt)
        force, (position, velocity) = self.force + pushed, self._motion
        away = position - self.rest
        free = Motion(
            self.rest + after.x_of_x * away + after.x_of_v * velocity + after.x_of_force * force,
            after.v_of_x * away + after.v_of_v * velocity + after.v_of_force * force,
        )
        speed = self.bounds.speed(self._motion, free.velocity, dt)
        # Where it is slowed it still is where it would be: no work is done, and only speed is lost.
        return Motion(self.bounds.place(self._motion, speed, dt, free.position), speed)

    def _rescale(self, factor: float) -> None:
        if self.impedance.stiffness:
            change = self._force_per_deflection(self.factor) - self._force_per_deflection(factor)
            self.rest += change * self._deflection / self.impedance.stiffness
