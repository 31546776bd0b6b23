"""Requests of the operator to the motion session; refusals become notices."""

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from itertools import count
from typing import NamedTuple

from PySide6.QtCore import QObject, Signal

from rotemina.app.errors import DriverUnusableError
from rotemina.app.language import translate
from rotemina.app.motion.device import OPERATOR
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import ConnectionState, SessionState
from rotemina.app.settings import UserSettings, load_settings
from rotemina.app.workbench.background import BackgroundWorker
from rotemina.app.workbench.help_topics import NoticeMessage, explain_error
from rotemina.app.workbench.notice_identity import identify_request
from rotemina.drivers.contract import DeviceState, Driver, MachineKind, SettingValue
from rotemina.sim.errors import InputError

# An older report does not describe the current motion.
MAX_REPORT_AGE_S = 1.0
_RESTING_STATES = (DeviceState.IDLE, DeviceState.FAULT, DeviceState.CLOSED)


def is_answering(state: SessionState) -> bool:
    """Return whether the device is connected and its latest report is recent."""
    is_fresh = state.age_s is None or state.age_s <= MAX_REPORT_AGE_S
    return state.connection is ConnectionState.CONNECTED and state.silent_s == 0.0 and is_fresh


def is_reported_moving(state: SessionState) -> bool:
    """Return whether the device reports motion or still has to start a requested one.

    Only this prevents the operator from choosing another device, and only until the motion is
    stopped.
    """
    return is_answering(state) and (state.activity not in _RESTING_STATES or state.queued > 0)


class OfferedPort(NamedTuple):
    """A port to which a driver can connect, and a description of what is there."""

    device: str
    about: str


class OperatorRequests(QObject):
    """Requests to a session; none of them waits for the device.

    Signals
    -------
    refused(str) : a request was refused, for this reason.
    withdrawn(str) : a waiting request ended without effect, for this reason.
    acted() : a request was accepted.
    settled(hashable) : the request or work of this subject was accepted or done, so the notice of
        an earlier failure is obsolete.
    ports_offered(tuple of OfferedPort) : the ports at which virtual boards now listen.
    panel_asked(str) : the operator asked for the panel of that name.
    arrived(str, object) : the panel of that name has received something; its tab is marked until
        it is opened.
    """

    refused = Signal(object)
    withdrawn = Signal(str)
    acted = Signal()
    settled = Signal(object)
    ports_offered = Signal(object)
    panel_asked = Signal(str)
    arrived = Signal(str, object)

    def __init__(self, session: MotionSession) -> None:
        super().__init__()
        self.session = session
        self.robot = session.robot
        # A separate worker, so that requests do not queue behind other work.
        self._aside = BackgroundWorker(self)
        self._request_numbers = count()

    def stop(self) -> None:
        """Stop all motion now, without waiting for anything."""
        self.session.stop(by=OPERATOR)

    def emergency_stop(self) -> None:
        """Stop all motion now and prevent motion until :meth:`release`."""
        self.session.emergency_stop(by=OPERATOR)

    def release(self) -> None:
        """Permit motion again after an emergency stop."""
        self.session.release()

    def go_to(self, targets: Mapping[str, float]) -> None:
        """Move axes to positions (SI)."""
        self.run_request(lambda: self.session.go_to(targets))

    def jog(self, axis: str, distance: float) -> None:
        """Move one axis by a distance (SI) from its last target."""
        self.run_request(lambda: self.session.jog(axis, distance))

    def home(self, axes: Sequence[str] | None = None) -> None:
        """Find the limit switches of the given axes, or of all axes with switches."""
        self.run_request(lambda: self.session.home(axes))

    def set_voltage(self, axis: str, voltage: float) -> None:
        """Set the voltage of a piezo amplifier, V, while its axis is at rest."""
        self.run_request(lambda: self.session.set_voltage(axis, voltage))

    def undo(self) -> None:
        """Return to where the axes rested before the latest move."""
        self.run_request(self.session.undo)

    def use_driver(self, driver_class: type[Driver], settings: Mapping[str, SettingValue]) -> bool:
        """Release the device and connect to another one; return whether that was started."""

        def connect_driver() -> None:
            try:
                driver = driver_class(self.robot, settings)
            except InputError:
                raise
            # The driver may be a plugin; none of its errors may end the program.
            except Exception as error:
                raise DriverUnusableError(
                    translate("shell", "driver {name!r} cannot be created: {kind}: {error}").format(
                        name=driver_class.name, kind=type(error).__name__, error=error
                    )
                ) from error
            self.session.use_driver(driver)

        return self.run_request(connect_driver)

    def use_simulator(self, preferences: UserSettings) -> bool:
        """Connect to the simulator unless it is in use; return whether it is or soon will be.

        The request is refused with a notice only if the connected device reports motion.
        """
        # Imported here, because a window that drives boards does not need it.
        from rotemina.drivers.simulator import Simulator

        state = self.session.snapshot()
        is_simulator = self.session.driver.built_in_kind is MachineKind.SIMULATED
        if is_simulator and state.connection in (
            ConnectionState.CONNECTED,
            ConnectionState.CONNECTING,
        ):
            return True
        if is_reported_moving(state):
            self.refused.emit(
                translate(
                    "shell", "The axes are still moving: stop them before you choose the simulator."
                )
            )
            return False
        return self.use_driver(Simulator, load_settings(preferences, Simulator))

    def offer_ports(self, ports: Iterable[tuple[str, str]]) -> None:
        """Announce the ports of virtual boards, each with a description; no ports end the offer."""
        self.ports_offered.emit(tuple(OfferedPort(*port) for port in ports))

    def reconnect(self) -> None:
        """Connect again after a failure."""
        self.run_request(self.session.reconnect)

    def disconnect_device(self) -> None:
        """Stop and disconnect from the device, which holds its position."""
        self.run_request(self.session.disconnect)

    def clear_fault(self) -> None:
        """Acknowledge the device's fault."""
        self.run_request(self.session.service.clear_fault)

    def confirm_position(self) -> None:
        """Confirm the position after a lost connection, so that the axes can move again."""
        self.run_request(self.session.confirm_position)

    def accept_parameters(self) -> None:
        """Accept the device's parameters as they are."""
        self.run_request(self.session.service.accept_parameters)

    def write_parameters(self) -> None:
        """Write the parameters of the robot file to the device."""
        self.run_request(self.session.service.write_parameters)

    def teach_floor(self) -> None:
        """Set the tip's floor to the current height of the tip."""
        self.run_request(self.session.bounds.teach_floor)

    def clear_floor(self) -> None:
        """Remove the tip's floor."""
        self.run_request(self.session.bounds.clear_floor)

    def ask_in_background(
        self,
        request: Callable[[], object],
        done: Callable[[], None] = lambda: None,
        undone: Callable[[], None] = lambda: None,
    ) -> None:
        """Make a request in the background because it checks a path, which may take seconds.

        A stop therefore never waits for it. The request uses a permit that was issued before
        this call. ``done`` is called after it was accepted, ``undone`` after it was refused and
        the refusal reported.
        """
        subject = identify_request(request)

        def on_refused(reason: str) -> None:
            # Any other text reports a program error.
            is_refusal = isinstance(reason, NoticeMessage)
            self.refused.emit(NoticeMessage(reason, subject=subject, is_refusal=is_refusal))
            undone()

        def on_accepted(_: object) -> None:
            self._report_accepted(subject)
            done()

        self._aside.run(f"request {next(self._request_numbers)}", request, on_accepted, on_refused)

    def run_request(self, request: Callable[[], object]) -> bool:
        """Make a request to the session and report a refusal; return whether it was accepted."""
        subject = identify_request(request)
        try:
            request()
        except (InputError, OSError, ValueError, RuntimeError) as error:
            self.refused.emit(explain_error(error, refused=subject))
            return False
        self._report_accepted(subject)
        return True

    def _report_accepted(self, subject: Hashable) -> None:
        self.acted.emit()
        self.settled.emit(subject)
