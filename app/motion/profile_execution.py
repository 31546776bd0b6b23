"""Profiles that a device executes: upload, trigger and abort."""

from dataclasses import dataclass

from rotemina.app.motion.admission import Admission
from rotemina.app.motion.compensation import Inverses
from rotemina.app.motion.device_link import DeviceLink
from rotemina.app.motion.guard import Guard
from rotemina.app.motion.mailbox import LoadProfile, RefusedError, RunProfile, able
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.reservations import Reservations
from rotemina.drivers.abilities import ProfileRunner
from rotemina.drivers.gate import Permit
from rotemina.drivers.profile import Profile
from rotemina.sim.messages import AxisName, message

_NO_PROFILES = message("engine", "driver {name} cannot execute profiles")


@dataclass(eq=False)
class Profiles:
    """One profile at a time, of one axis, checked and owned like a move."""

    _link: DeviceLink
    _admission: Admission
    _guard: Guard
    _inverses: Inverses
    _reservations: Reservations
    _loaded: tuple[Profile, float] | None = None  # and where its axis was

    def upload(
        self, profile: Profile, owner: str = OPERATOR, *, permit: Permit | None = None
    ) -> None:
        """Upload a profile to the device, from the present command of its axis; nothing moves yet.

        Its extremes are checked against range and keep-out. In the slow zone a faster profile is
        refused, except for an owner who has reserved every axis: a deliberate thrust. The floor
        holds for everybody.

        Raises
        ------
        OutOfLimitsError
            If an extreme is beyond a limit, or the tip might leave its bounds.
        InputError
            If a segment is beyond what the axis can.
        RefusedError
            If the device runs no profiles, is not at rest, or as for any move.
        """
        permit = self._admission.drawn(permit)
        able(self._link.driver, ProfileRunner, _NO_PROFILES)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("a profile")
            start = self._commanded(profile.axis)
            profile.check(self._link.robot, start)
            self._check_profile(profile, start, owner)
            self._admission.queue(LoadProfile(profile), permit, (profile.axis,), owner)
            self._loaded = (profile, start)

    def trigger(self, owner: str = OPERATOR, *, permit: Permit | None = None) -> None:
        """Let the profile that was uploaded run; stop and :meth:`abort` end it.

        Raises
        ------
        OutOfLimitsError
            If the tip might leave its bounds by now.
        RefusedError
            If none was uploaded, its axis has moved since, or as :meth:`upload`.
        """
        permit = self._admission.drawn(permit)
        able(self._link.driver, ProfileRunner, _NO_PROFILES)
        with self._admission.lock:
            self._admission.refuse_unless_at_rest("a profile")
            if self._loaded is None:
                raise RefusedError(message("engine", "no profile was uploaded; upload one first"))
            profile, start = self._loaded
            if self._commanded(profile.axis) != start:
                raise RefusedError(
                    message(
                        "engine",
                        "axis {axis} has moved since its profile was uploaded; upload it again",
                    ).fill(axis=AxisName(profile.axis))
                )
            self._check_profile(profile, start, owner)
            end = start + sum(segment.length for segment in profile.segments)
            run = RunProfile({profile.axis: end})
            self._admission.queue_move(run, permit, (profile.axis,), owner)
            self._loaded = None

    def check_thrust(self, axis: str, ends: tuple[float, float], speed: float) -> None:
        """Refuse a distance of one axis, at this speed at most, that no profile may travel.

        This includes profiles of an owner who has reserved every axis.

        Raises
        ------
        OutOfLimitsError
            As :meth:`upload`.
        """
        self._guard.profile(self._admission.envelope(), axis, ends, speed, thrust=True)

    def abort(self) -> None:
        """Halt the profile that runs, without a fault, or forget the one that waits.

        Raises
        ------
        RefusedError
            If the device runs none, or is not connected.
        """
        able(self._link.driver, ProfileRunner, _NO_PROFILES)
        self._loaded = None
        self._link.ask_able(ProfileRunner, _NO_PROFILES, lambda driver, _: driver.abort())

    def _commanded(self, axis: str) -> float:
        return float(self._link.worker.state.command.get(axis, float("nan")))

    def _check_profile(self, profile: Profile, start: float, owner: str) -> None:
        low = high = at = start
        for segment in profile.segments:
            places = [at + extreme for extreme in segment.extremes()]
            low, high = min(low, *places), max(high, *places)
            at += segment.length
        for end in (low, high):
            self._inverses.check({profile.axis: end})
        fastest = max(segment.greatest_speed() for segment in profile.segments)
        self._guard.profile(
            self._admission.envelope(),
            profile.axis,
            (low, high),
            fastest,
            thrust=self._reservations.held_by(owner),
        )
