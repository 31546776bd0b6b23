"""Impedance law: the stick's deflection is a force on a virtual mechanism that the robot follows.

    F = z φ,      M ẍ + D ẋ + K (x − x0) = F + R

F is F_i = z_i φ_j,i of the paper, and R is the contact force
(:mod:`rotemina.app.motion.teleoperation.force_feedback`).

**Passivity.** With E = M v²/2 + K (x − x0)²/2, exactly E' − E + losses = (F + R)(x' − x) in each
step. ``start`` and ``hold_at`` reset E. Limits of speed and range only remove energy. A limit of
acceleration could add energy, because the mechanism would brake later than without it. Therefore M
must be so large that no sequence of forces reaches this limit. For coarser scales the force is
limited accordingly.
"""

from rotemina.app.errors import ScalingError
from rotemina.app.motion.teleoperation.force_feedback import ContactFeedback
from rotemina.app.motion.teleoperation.reference import CoordinateBounds, ReferenceMotion
from rotemina.app.motion.teleoperation.scaling import ScalingLaw
from rotemina.app.motion.teleoperation.virtual_impedance import VirtualImpedance
from rotemina.sim.messages import format_rounded


class ImpedanceLaw(ScalingLaw):
    """Law in which the stick pushes a virtual mechanism that the coordinate follows.

    Parameters
    ----------
    bounds : CoordinateBounds
    impedance : VirtualImpedance
    contact : ContactFeedback, optional
        Contact force feedback. The reaction passed to :meth:`step` is then the contact signal: a
        deviation (real minus model) or a force on the tip. Without it, reactions are ignored.

    Raises
    ------
    ScalingError
        If the mechanism could accelerate faster than the coordinate may, or if the contact
        feedback could add energy. The message names the bound and what to change.
    """

    def __init__(
        self,
        bounds: CoordinateBounds,
        impedance: VirtualImpedance,
        contact: ContactFeedback | None = None,
    ) -> None:
        super().__init__(bounds)
        self.impedance = impedance
        self.contact = contact
        max_total_force = bounds.max_acceleration / impedance.max_acceleration_per_force
        contact_reserve = 0.0
        if contact is not None:
            contact.check_passivity(impedance)
            contact_reserve = contact.max_force
        self._max_force = max_total_force - contact_reserve
        if impedance.force > self._max_force * (1.0 + 1e-9):
            max_acceleration = (
                impedance.force + contact_reserve
            ) * impedance.max_acceleration_per_force
            required_mass = impedance.mass * max_acceleration / bounds.max_acceleration
            raise ScalingError(
                "impedance: forces of up to {force} could accelerate the mass of {mass} "
                "by {reached} per s², but the axis permits {max_acceleration}; lower the "
                "force, or use a mass of about {wanted} with the same damping ratio or "
                "time constant",
                force=format_rounded(impedance.force + contact_reserve, 6),
                mass=format_rounded(impedance.mass, 6),
                reached=format_rounded(max_acceleration, 6),
                max_acceleration=format_rounded(bounds.max_acceleration, 6),
                wanted=format_rounded(required_mass, 6),
            )
        #: Rest position of the spring, x0, m or rad.
        self.spring_rest = self._motion.position

    @property
    def force(self) -> float:
        """Force of the latest deflection."""
        return self._compute_full_force(self.factor) * self._deflection

    @property
    def effective_factor(self) -> float:
        """The factor in use, which the acceleration limit may reduce below ``factor``."""
        return self._compute_full_force(self.factor) / self.impedance.force

    def _compute_full_force(self, factor: float) -> float:
        return min(factor * self.impedance.force, self._max_force)

    def _set_anchor(self) -> None:
        # The spring balances the current force, so a coordinate at rest stays at rest.
        self.spring_rest = self._motion.position
        if self.impedance.stiffness:
            self.spring_rest -= self.force / self.impedance.stiffness

    def _step(self, dt: float, reaction: float) -> ReferenceMotion:
        contact_force = 0.0 if self.contact is None else self.contact.compute_force(reaction)
        response = self.impedance.compute_response(dt)
        force, (position, velocity) = self.force + contact_force, self._motion
        offset = position - self.spring_rest
        unlimited_motion = ReferenceMotion(
            self.spring_rest
            + response.x_of_x * offset
            + response.x_of_v * velocity
            + response.x_of_force * force,
            response.v_of_x * offset + response.v_of_v * velocity + response.v_of_force * force,
        )
        speed = self.bounds.limit_speed(self._motion, unlimited_motion.velocity, dt)
        # Reducing the speed does not change the position, so it does no work and only removes
        # energy.
        return ReferenceMotion(
            self.bounds.find_position(self._motion, speed, dt, unlimited_motion.position), speed
        )

    def _rescale(self, factor: float) -> None:
        if self.impedance.stiffness:
            force_change = self._compute_full_force(self.factor) - self._compute_full_force(factor)
            self.spring_rest += force_change * self._deflection / self.impedance.stiffness
