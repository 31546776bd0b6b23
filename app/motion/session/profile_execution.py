"""Requests for profiles, which a device executes by itself: upload, trigger and abort."""

from dataclasses import dataclass

from rotemina.app.errors import RequestRefusedError
from rotemina.app.motion.device import (
    OPERATOR,
    DeviceLink,
    LoadProfileCommand,
    RunProfileCommand,
    require_ability,
)
from rotemina.app.motion.limits import Guard
from rotemina.app.motion.session.admission import RequestAdmission
from rotemina.app.motion.session.compensation import AxisInverses
from rotemina.app.motion.session.reservations import AxisReservations
from rotemina.drivers.abilities import MotionProfile, ProfileRunner
from rotemina.drivers.contract import Permit
from rotemina.sim.messages import AxisName, message

_NO_PROFILES = message("engine", "driver {name} cannot execute profiles")


@dataclass(eq=False)
class ProfileRequests:
    """Requests for one profile of one axis at a time, checked and owned like a move."""

    _link: DeviceLink
    _admission: RequestAdmission
    _guard: Guard
    _inverses: AxisInverses
    _reservations: AxisReservations
    # The uploaded profile, and the command of its axis at the time of the upload.
    _uploaded: tuple[MotionProfile, float] | None = None

    def upload(
        self, profile: MotionProfile, owner: str = OPERATOR, *, permit: Permit | None = None
    ) -> None:
        """Upload a profile that starts at the current command of its axis; nothing moves yet.

        The extremes of the profile are checked against range and keep-out. A profile that is too
        fast for the slow zone is refused, unless its owner has reserved all axes: then it is a
        deliberate thrust. The floor limits the profiles of all owners.

        Raises
        ------
        OutOfLimitsError
            If an extreme exceeds a limit, or the tip might leave its bounds.
        InputError
            If a segment exceeds a limit of the axis.
        RequestRefusedError
            If the device runs no profiles or is not at rest, or for the same reasons as any move.
        """
        permit = self._admission.resolve_permit(permit)
        require_ability(self._link.driver, ProfileRunner, _NO_PROFILES)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("a profile")
            start = self._read_command(profile.axis)
            profile.check(self._link.robot, start)
            self._check_profile(profile, start, owner)
            self._admission.queue(LoadProfileCommand(profile), permit, (profile.axis,), owner)
            self._uploaded = (profile, start)

    def trigger(self, owner: str = OPERATOR, *, permit: Permit | None = None) -> None:
        """Run the uploaded profile; a stop and :meth:`abort` end it.

        Raises
        ------
        OutOfLimitsError
            If the tip might now leave its bounds.
        RequestRefusedError
            If no profile was uploaded, or its axis has moved since. See also :meth:`upload`.
        """
        permit = self._admission.resolve_permit(permit)
        require_ability(self._link.driver, ProfileRunner, _NO_PROFILES)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("a profile")
            if self._uploaded is None:
                raise RequestRefusedError("no profile was uploaded; upload one first")
            profile, start = self._uploaded
            if self._read_command(profile.axis) != start:
                raise RequestRefusedError(
                    "axis {axis} has moved since its profile was uploaded; upload it again",
                    axis=AxisName(profile.axis),
                )
            self._check_profile(profile, start, owner)
            end = start + sum(segment.displacement for segment in profile.segments)
            run = RunProfileCommand({profile.axis: end})
            self._admission.queue_move(run, permit, (profile.axis,), owner)
            self._uploaded = None

    def check_thrust(self, axis: str, ends: tuple[float, float], speed: float) -> None:
        """Refuse a thrust of one axis between ``ends`` that no owner may request.

        ``speed`` is its highest speed. An owner who has reserved all axes may request a thrust.

        Raises
        ------
        OutOfLimitsError
            See :meth:`upload`.
        """
        self._guard.check_profile(
            self._admission.compute_envelope(), axis, ends, speed, thrust=True
        )

    def abort(self) -> None:
        """Halt the running profile without a fault, and forget an uploaded one.

        Raises
        ------
        RequestRefusedError
            If the device runs no profiles, or is not connected.
        """
        require_ability(self._link.driver, ProfileRunner, _NO_PROFILES)
        self._uploaded = None
        self._link.queue_ability_call(ProfileRunner, _NO_PROFILES, lambda driver, _: driver.abort())

    def _read_command(self, axis: str) -> float:
        return float(self._link.worker.state.command.get(axis, float("nan")))

    def _check_profile(self, profile: MotionProfile, start: float, owner: str) -> None:
        low = high = segment_start = start
        for segment in profile.segments:
            positions = [segment_start + extreme for extreme in segment.find_extremes()]
            low, high = min(low, *positions), max(high, *positions)
            segment_start += segment.displacement
        for end in (low, high):
            self._inverses.check_targets({profile.axis: end})
        max_speed = max(segment.compute_max_speed() for segment in profile.segments)
        self._guard.check_profile(
            self._admission.compute_envelope(),
            profile.axis,
            (low, high),
            max_speed,
            thrust=self._reservations.is_reserved_by(owner),
        )
