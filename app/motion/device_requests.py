"""What a session asks of a device's special abilities: profiles, captures, voltage, tool."""

import threading
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Container, Mapping, Sequence
from typing import Any

from rotemina.app.motion.guard import Guard, PositionEnvelope
from rotemina.app.motion.mailbox import (
    LoadProfile,
    RefusedError,
    RunProfile,
    SetVoltage,
    refuse_overtaken,
)
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.service_requests import ServiceRequests
from rotemina.drivers.abilities import Capturer, ProfileRunner, VoltageOutput
from rotemina.drivers.capture import Captured
from rotemina.drivers.driver import Driver
from rotemina.drivers.gate import Epoch, Permit, Purpose
from rotemina.drivers.profile import Profile
from rotemina.drivers.tool import ToolOutput
from rotemina.sim.robot.model import PiezoAxis
from rotemina.sim.trajectory.limits import OutOfLimitsError


class DeviceRequests(ServiceRequests, ABC):
    """Requests beside moves; whatever moves an axis is checked and owned as a move is.

    Parameters are those of :class:`~rotemina.app.motion.device_session.DeviceSession`.
    """

    def __init__(self, driver: Driver, **options: Any) -> None:
        super().__init__(driver, **options)
        self._guard = Guard(self.robot)
        self._loaded: tuple[Profile, float] | None = None  # and where its axis was
        self._captured: deque[Captured] = deque()
        self._collecting = threading.Event()
        self._collected_at: Epoch | None = None

    # --- reservations ---------------------------------------------------------------------------

    def reserve(self, owner: str) -> None:
        """Keep every axis for an owner, at rest too, until it sets them free.

        Nobody else moves the machine meanwhile, unless by taking over; a stop is always possible.
        Who has reserved every axis may thrust through the slow zone (:meth:`upload_profile`).

        Raises
        ------
        RefusedError
            If motion is locked, the machine moves, or an axis is another owner's.
        """
        with self._lock:
            self._refuse_unless_at_rest("reserving the axes")
            self._worker.ownership.reserve(self.driver.axes, owner)

    def check_reservable(self, owner: str) -> None:
        """Refuse what :meth:`reserve` would refuse now, and reserve nothing.

        Raises
        ------
        RefusedError
            As :meth:`reserve`.
        """
        self._refuse_unless_at_rest("reserving the axes")
        self._worker.ownership.check(self.driver.axes, owner)

    def has_reserved(self, owner: str) -> bool:
        """Tell whether every axis is reserved for an owner: nobody has taken one over."""
        return self._worker.ownership.has_reserved(self.driver.axes, owner)

    def set_free(self, owner: str) -> None:
        """End an owner's reservations."""
        self._worker.ownership.set_free(owner)

    # --- profiles -------------------------------------------------------------------------------

    def upload_profile(
        self, profile: Profile, owner: str = OPERATOR, *, permit: Permit | None = None
    ) -> None:
        """Hand a profile to the device, from where its axis is commanded now; nothing moves yet.

        Its extremes are held against range and keep-out. Within the slow zone it is refused where
        it is faster than that allows, except for an owner who has reserved every axis: a
        deliberate thrust. The floor itself holds for everybody.

        Raises
        ------
        OutOfLimitsError
            If an extreme is beyond a limit, or the tip might leave its bounds.
        InputError
            If a segment is beyond what the axis can.
        RefusedError
            If the device runs no profiles, is not at rest, or as for any move.
        """
        permit = self._drawn(permit)
        self._profile_runner()
        with self._lock:
            self._refuse_unless_at_rest("a profile")
            start = self._commanded(profile.axis)
            profile.check(self.robot, start)
            self._check_profile(profile, start, owner)
            with self._worker.ownership.claimed((profile.axis,), owner):
                self._mailbox.post(LoadProfile(profile), permit.owned((profile.axis,), owner))
            self._loaded = (profile, start)

    def trigger_profile(self, owner: str = OPERATOR, *, permit: Permit | None = None) -> None:
        """Let the profile that was uploaded run; stop and :meth:`abort_profile` end it.

        Raises
        ------
        OutOfLimitsError
            If the tip might leave its bounds by now.
        RefusedError
            If none was uploaded, its axis has moved since, or as :meth:`upload_profile`.
        """
        permit = self._drawn(permit)
        self._profile_runner()
        with self._lock:
            self._refuse_unless_at_rest("a profile")
            if self._loaded is None:
                raise RefusedError("no profile was uploaded; upload one first")
            profile, start = self._loaded
            if self._commanded(profile.axis) != start:
                raise RefusedError(
                    f"axis {profile.axis} has moved since its profile was uploaded; upload it again"
                )
            self._check_profile(profile, start, owner)
            end = start + sum(segment.length for segment in profile.segments)
            with self._worker.ownership.claimed((profile.axis,), owner):
                self._note_rest()
                run = RunProfile({profile.axis: end})
                self._mailbox.post(run, permit.owned((profile.axis,), owner))
            self._loaded = None

    def check_thrust(self, axis: str, ends: tuple[float, float], speed: float) -> None:
        """Refuse a way of one axis, at this speed at most, that no profile may make.

        That is, none of an owner who has reserved every axis.

        Raises
        ------
        OutOfLimitsError
            As :meth:`upload_profile`.
        """
        self._guard.profile(self._envelope(), axis, ends, speed, thrust=True)

    def abort_profile(self) -> None:
        """Halt the profile that runs, without a fault, or forget the one that waits.

        Raises
        ------
        RefusedError
            If the device runs none, or is not connected.
        """
        self._profile_runner()
        self._loaded = None
        self._ask(_abort)

    # --- captures -------------------------------------------------------------------------------

    def capture(self, axes: Sequence[str], rate_hz: float, count: int) -> None:
        """Begin to sample axes at a high rate; :meth:`captured` hands the samples out.

        Raises
        ------
        RefusedError
            If the device cannot, or is not connected.
        """
        if not isinstance(self.driver, Capturer):
            raise RefusedError(f"driver {self.driver.name!r} cannot capture")
        wanted = tuple(axes)

        def begin(driver: Driver, _: Permit) -> None:
            assert isinstance(driver, Capturer), "the session refuses on any other"
            driver.capture(wanted, rate_hz, count)
            self._captured.clear()

        self._ask(begin)

    def captured(self) -> tuple[Captured, ...]:
        """Return what has come of the latest capture since the last call, and ask for more.

        It never waits: what the device has by now is among the answer to the next call.
        """
        found = []
        while self._captured:
            found.append(self._captured.popleft())
        epoch = self.epoch
        if self._collecting.is_set() and self._collected_at == epoch:
            return tuple(found)
        self._collected_at = epoch  # a stop drops what was asked for before

        def collect(driver: Driver, _: Permit) -> None:
            self._collecting.clear()
            if isinstance(driver, Capturer) and (part := driver.captured()) is not None:
                self._captured.append(part)

        self._collecting.set()
        self._ask(collect)
        return tuple(found)

    # --- voltage and tool -----------------------------------------------------------------------

    def set_voltage(
        self, axis: str, voltage: float, owner: str = OPERATOR, *, permit: Permit | None = None
    ) -> None:
        """Put out a piezo's voltage, V; where that sends the axis is held against all limits.

        Raises
        ------
        OutOfLimitsError
            If the voltage or its position is beyond a limit, or the tip might leave its bounds.
        RefusedError
            If the device cannot, the machine is not at rest, the tip is so low that it must go
            slowly, or as for any move.
        """
        permit = self._drawn(permit)
        if not isinstance(self.driver, VoltageOutput):
            raise RefusedError(f"driver {self.driver.name!r} cannot put out a voltage")
        model = self.robot.axes.get(axis)
        if not isinstance(model, PiezoAxis) or model.controller is not None:
            raise OutOfLimitsError(f"axis {axis!r} has no amplifier that could be given a voltage")
        bounds = model.voltage_range
        if bounds is not None and not bounds[0] <= voltage <= bounds[1]:
            raise OutOfLimitsError(
                f"axis {axis}: {voltage:g} V: must be {bounds[0]:g} to {bounds[1]:g} V"
            )
        targets = {axis: voltage * model.gain}
        with self._lock:
            self._refuse_unless_at_rest("putting out a voltage")
            segments = self._guard.move(self._envelope(), targets)
            if len(segments) > 1 or segments[0].speeds:
                raise RefusedError(
                    f"axis {axis}: a voltage acts at once, too fast so close above the tip's "
                    "floor; move it instead"
                )
            with self._worker.ownership.claimed((axis,), owner):
                self._note_rest()
                command = SetVoltage(axis, voltage, targets)
                self._mailbox.post(command, permit.owned((axis,), owner))

    @property
    def tool_on(self) -> bool | None:
        """Whether the tool is on; None where the device has none."""
        return self.driver.tool_on if isinstance(self.driver, ToolOutput) else None

    def switch_tool(self, on: bool, *, permit: Permit | None = None) -> None:
        """Switch the tool; off is possible in a fault and while a stop is latched too.

        Raises
        ------
        RefusedError
            If the device has none or is not connected; to switch on, if motion is locked.
        """
        permit = self._drawn(permit)
        if not isinstance(self.driver, ToolOutput):
            raise RefusedError(f"driver {self.driver.name!r} has no tool that could be switched")
        if on:
            self._refuse_if_locked()

        def switch(driver: Driver, permit: Permit) -> None:
            assert isinstance(driver, ToolOutput), "the session refuses on any other"
            driver.switch_tool(on, permit=permit)

        # Switched on, what has come since counts; switched off, nothing does.
        self._ask(switch, permit.meant_for(Purpose.SERVICE if on else Purpose.ENQUIRY))

    # --- what a motion session adds -------------------------------------------------------------

    @abstractmethod
    def _refuse_if_locked(self) -> None:
        """Refuse motion while it is locked."""

    @abstractmethod
    def _envelope(self, driven: Container[str] = ()) -> PositionEnvelope:
        """Return where the axes may be."""

    @abstractmethod
    def _check_seen(self, targets: Mapping[str, float]) -> None:
        """Refuse targets beyond what the inverse of their axis saw."""

    @abstractmethod
    def _note_rest(self) -> None:
        """Keep where the machine rests before it begins to move."""

    @abstractmethod
    def _forget_way_back(self) -> None:
        """Keep no place to come back to: what commands mean is about to change."""

    def _drawn(self, permit: Permit | None) -> Permit:
        """Return the permit of a plan, which still holds, or one of now.

        Raises
        ------
        RefusedError
            If a stop has come since the plan began.
        """
        if permit is None:
            return self.permit()
        if not permit.valid:
            refuse_overtaken(permit)
        return permit

    def _profile_runner(self) -> None:
        if not isinstance(self.driver, ProfileRunner):
            raise RefusedError(f"driver {self.driver.name!r} cannot run profiles by itself")

    def _refuse_unless_at_rest(self, what: str) -> None:
        self._refuse_if_locked()
        if not self._worker.at_rest:
            raise RefusedError(f"the machine is still moving; stop it or wait before {what}")

    def _commanded(self, axis: str) -> float:
        return float(self._worker.state.command.get(axis, float("nan")))

    def _check_profile(self, profile: Profile, start: float, owner: str) -> None:
        low = high = at = start
        for segment in profile.segments:
            places = [at + extreme for extreme in segment.extremes()]
            low, high = min(low, *places), max(high, *places)
            at += segment.length
        for end in (low, high):
            self._check_seen({profile.axis: end})
        fastest = max(segment.greatest_speed() for segment in profile.segments)
        self._guard.profile(
            self._envelope(), profile.axis, (low, high), fastest, thrust=self.has_reserved(owner)
        )


def _abort(driver: Driver, _: Permit) -> None:
    assert isinstance(driver, ProfileRunner), "the session refuses on any other"
    driver.abort()
