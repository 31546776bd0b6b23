"""What an operator asks of the motion session: thin requests, whose refusals are told."""

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from itertools import count
from typing import NamedTuple

from PySide6.QtCore import QObject, Signal

from rotemina.app.driver_settings import kept
from rotemina.app.motion.ownership import OPERATOR
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Connection, SessionState
from rotemina.app.settings import Settings
from rotemina.app.shell.background import Background
from rotemina.app.shell.help_topics import Explained, explained
from rotemina.app.shell.language import translate
from rotemina.app.shell.notice_identity import request_subject
from rotemina.drivers.driver import Driver, MachineKind
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.settings import SettingValue
from rotemina.sim.errors import InputError

MAX_AGE_S = 1.0  # of a report of motion: an older one says nothing of now
_STEADY = (DeviceState.IDLE, DeviceState.FAULT, DeviceState.CLOSED)


def is_answering(state: SessionState) -> bool:
    """Return whether the device reports: not if it failed, is being opened, is silent or hangs."""
    is_fresh = state.age_s is None or state.age_s <= MAX_AGE_S
    return state.connection is Connection.CONNECTED and state.silent_s == 0.0 and is_fresh


def is_seen_moving(state: SessionState) -> bool:
    """Return whether the device reports motion, or has yet to do what it was asked to.

    Only that keeps the operator from another device, and only until it is stopped.
    """
    return is_answering(state) and (state.activity not in _STEADY or state.queued > 0)


class OfferedPort(NamedTuple):
    """A port that a driver can be connected to, and what is there."""

    device: str
    about: str


class DriverUnusableError(InputError):
    """A driver whose constructor fails; the message says how."""


class Requests(QObject):
    """Requests to a session; none of them waits for the device.

    Signals
    -------
    refused(str) : a request that was not taken, and why.
    withdrawn(str) : a request that waited ended without effect, and why.
    acted() : a request was taken.
    settled(hashable) : the request or work of this subject was taken or done; the notice of an
        earlier failure is over.
    ports_offered(tuple of OfferedPort) : where virtual boards listen now.
    panel_asked(str) : the operator asked for the panel of that name.
    arrived(str, object) : the panel of that name has received something; its tab is marked, until
        it is looked at.
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
        # Apart from other work, behind which a request must not wait.
        self._aside = Background(self)
        self._asked_aside = count()

    # --- stop -------------------------------------------------------------------------------------

    def stop(self) -> None:
        """Stop all motion now; this waits for nothing."""
        self.session.stop(by=OPERATOR)

    def emergency_stop(self) -> None:
        """Stop all motion now, and let nothing move until :meth:`release`."""
        self.session.emergency_stop(by=OPERATOR)

    def release(self) -> None:
        """Let the machine move again after an emergency stop."""
        self.session.release()

    # --- motion -----------------------------------------------------------------------------------

    def go_to(self, targets: Mapping[str, float]) -> None:
        """Move axes to positions (SI)."""
        self.ask(lambda: self.session.go_to(targets))

    def jog(self, axis: str, distance: float) -> None:
        """Move one axis by a distance (SI) from its last target."""
        self.ask(lambda: self.session.jog(axis, distance))

    def home(self, axes: Sequence[str] | None = None) -> None:
        """Find the limit switches of axes, or of all that have some."""
        self.ask(lambda: self.session.home(axes))

    def set_voltage(self, axis: str, voltage: float) -> None:
        """Put out a piezo amplifier's voltage, V, from rest."""
        self.ask(lambda: self.session.set_voltage(axis, voltage))

    def undo(self) -> None:
        """Go back to where the axes rested before the latest move."""
        self.ask(self.session.undo)

    # --- connection -------------------------------------------------------------------------------

    def use_driver(self, kind: type[Driver], settings: Mapping[str, SettingValue]) -> bool:
        """Release the device and connect to another one; return whether that was begun."""

        def use() -> None:
            try:
                driver = kind(self.robot, settings)
            except InputError:
                raise
            except Exception as error:  # whatever a plugin raises, the window stays
                raise DriverUnusableError(
                    translate("shell", "driver {name!r} cannot be created: {kind}: {error}").format(
                        name=kind.name, kind=type(error).__name__, error=error
                    )
                ) from error
            self.session.use(driver)

        return self.ask(use)

    def use_simulator(self, preferences: Settings) -> bool:
        """Connect to the simulator, unless one is in use; return whether it is, or will be soon.

        Only motion that the present device reports is a reason to refuse; a notice says so.
        """
        # Loaded where it is wanted: a window that drives boards does without it.
        from rotemina.drivers.simulator.driver import Simulator

        state = self.session.snapshot()
        is_one = self.session.driver.built_in_kind is MachineKind.SIMULATED
        if is_one and state.connection in (Connection.CONNECTED, Connection.CONNECTING):
            return True
        if is_seen_moving(state):
            self.refused.emit(
                translate(
                    "shell", "The axes are still moving: stop them before you choose the simulator."
                )
            )
            return False
        return self.use_driver(Simulator, kept(preferences, Simulator))

    def offer_ports(self, ports: Iterable[tuple[str, str]]) -> None:
        """Tell where virtual boards listen now, each with what is there; nowhere ends that."""
        self.ports_offered.emit(tuple(OfferedPort(*port) for port in ports))

    def reconnect(self) -> None:
        """Connect again after a failure."""
        self.ask(self.session.reconnect)

    def let_go(self) -> None:
        """Stop, and disconnect from the device; it holds."""
        self.ask(self.session.disconnect)

    def clear_fault(self) -> None:
        """Acknowledge the device's fault."""
        self.ask(self.session.service.clear_fault)

    def confirm_position(self) -> None:
        """Trust the position again after a lost connection."""
        self.ask(self.session.confirm_position)

    def accept_parameters(self) -> None:
        """Move with the device's parameters as they are."""
        self.ask(self.session.service.accept_parameters)

    def write_parameters(self) -> None:
        """Write the robot file's parameters into the device."""
        self.ask(self.session.service.write_parameters)

    # --- bounds of the tip ------------------------------------------------------------------------

    def teach_floor(self) -> None:
        """Put the tip's floor where the tip is now."""
        self.ask(self.session.bounds.teach_floor)

    def clear_floor(self) -> None:
        """Take the tip's floor away."""
        self.ask(self.session.bounds.clear_floor)

    def ask_aside(
        self,
        request: Callable[[], object],
        done: Callable[[], None] = lambda: None,
        undone: Callable[[], None] = lambda: None,
    ) -> None:
        """Make a request that checks a path, which may take seconds: away from the window's thread.

        So a stop never waits for it. The request takes a permit that was drawn before this call.
        ``done`` or ``undone`` is called when it was taken, or was refused and that is told.
        """
        subject = request_subject(request)

        def refused(reason: str) -> None:
            is_refusal = isinstance(reason, Explained)  # else a fault of the program
            self.refused.emit(Explained(reason, subject=subject, is_refusal=is_refusal))
            undone()

        def taken(_: object) -> None:
            self._take(subject)
            done()

        self._aside.run(f"request {next(self._asked_aside)}", request, taken, refused)

    def ask(self, request: Callable[[], object]) -> bool:
        """Make a request of the session; a refusal is told. Return whether it was taken."""
        subject = request_subject(request)
        try:
            request()
        except (InputError, OSError, ValueError, RuntimeError) as error:
            self.refused.emit(explained(error, refused=subject))
            return False
        self._take(subject)
        return True

    def _take(self, subject: Hashable) -> None:
        self.acted.emit()
        self.settled.emit(subject)
