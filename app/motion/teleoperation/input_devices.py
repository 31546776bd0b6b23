"""The operator's input devices: discovery, opening, reading, and one resulting intent."""

import logging
import threading
from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from rotemina.app.motion.teleoperation.axis_calibration import Calibration, CalibrationFolder
from rotemina.app.motion.teleoperation.default_profile import default_profile
from rotemina.app.motion.teleoperation.input_arbiter import DevicesView, InputArbiter
from rotemina.app.motion.teleoperation.intent import Intent
from rotemina.app.motion.teleoperation.profile import (
    DeviceMapping,
    ListedProfile,
    OperatorRole,
    Profile,
    ProfileError,
    listed_profiles,
    save_profile,
)
from rotemina.app.motion.teleoperation.profile_check import PluggedDevice, assigned
from rotemina.drivers.errors import DriverError
from rotemina.drivers.inputs.device import InputDevice, InputReading, Rumbler
from rotemina.drivers.inputs.hub import Changes, InputHub
from rotemina.sim.messages import marked

VIEW_S = 1.0 / 30.0  # no screen needs more

_LOG = logging.getLogger(__name__)
_PAD = "keys"  # the source of the pad
# Sources of what is always there, if anybody uses it or not: they come after every other.
_RANKS = {"board": 1, _PAD: 2}


@dataclass(frozen=True, slots=True)
class InputSnapshot:
    """The readings of all devices at one instant, and the resulting intent.

    Attributes
    ----------
    intent : Intent
    readings : mapping of str to tuple of InputReading
        By device key, what each said since the look before.
    """

    intent: Intent
    readings: Mapping[str, tuple[InputReading, ...]]


class InputDevices:
    """Keeps every device that is plugged in open, and the input arbiter informed.

    :meth:`look` may take some ms and is for a thread of its own, about once a second;
    :meth:`step` is for the thread that steers. Everything else may be called from any thread.

    Parameters
    ----------
    hub : InputHub
    robot_axes : sequence of str
    folder : Path
        Of the user's ``calibrations`` and ``profiles``.
    """

    def __init__(self, hub: InputHub, robot_axes: Sequence[str], folder: Path) -> None:
        self.hub = hub
        self.arbiter = InputArbiter(robot_axes)
        self.calibrations = CalibrationFolder(folder / "calibrations")
        self._profiles = folder / "profiles"
        self._chosen: Profile | None = None  # None: one is made for what is plugged in
        #: The profile in use, or None.
        self.profile: Profile | None = None
        self._open: dict[str, InputDevice] = {}
        self._changes: deque[Changes] = deque()
        self._listeners: tuple[Callable[[InputSnapshot], None], ...] = ()
        self._view = DevicesView()
        self._changed = True  # by somebody, and not yet in the view
        # Guards the arbiter and what is open; held for a step, and never while a device is opened.
        self._lock = threading.RLock()

    # --- profiles and calibrations ----------------------------------------------------------------

    @property
    def profiles(self) -> tuple[ListedProfile, ...]:
        """The user's saved profiles, invalid ones with their problem."""
        return listed_profiles(self._profiles)

    def use(self, profile: Profile | None) -> None:
        """Use a profile, or, with None, one made for what is plugged in.

        Raises
        ------
        ProfileError
            As :meth:`InputArbiter.use`; then the one before stays.
        """
        with self._lock:
            if profile is not None:
                self._hand_to_arbiter(profile)
            self._chosen = profile
            self._changed = True
            if profile is None:
                self._use_automatic(anew=True)

    def keep(self, profile: Profile) -> Path:
        """Write a profile into the user's folder, and return where it is.

        Raises
        ------
        FileWriteError
            If it cannot be written.
        """
        return save_profile(self._profiles, profile)

    def calibrate(self, key: str, calibration: Calibration) -> None:
        """Use and keep another calibration of a device that is plugged in.

        Raises
        ------
        CalibrationError, FileWriteError
            If it is for another device, that is not there, or it cannot be kept.
        """
        with self._lock:
            self.arbiter.calibrate(key, calibration)
            self._changed = True
            device = self._open.get(key)
        if device is not None:
            self.calibrations.save(device.identity, calibration)

    # --- devices ----------------------------------------------------------------------------------

    @property
    def view(self) -> DevicesView:
        """The state for display, at most ``VIEW_S`` old; never waits.

        Sources and devices that cannot be used are in :attr:`InputHub.problems`.
        """
        return self._view

    def listen(self, tell: Callable[[InputSnapshot], None]) -> Callable[[], None]:
        """Call ``listener`` with every step, on its thread; return how to end that.

        ``tell`` must neither wait nor raise; that of a queue is good.
        """
        with self._lock:
            self._listeners = (*self._listeners, tell)

        def leave() -> None:
            with self._lock:
                self._listeners = tuple(one for one in self._listeners if one is not tell)

        return leave

    def look(self) -> None:
        """Detect connected and removed devices; the next step handles them."""
        changes = self.hub.poll()
        if changes.arrived or changes.left:
            self._changes.append(changes)

    def step(self, now_s: float) -> InputSnapshot:
        """Read every device and return what the operator wants; never waits for one."""
        while self._changes:
            self._follow(self._changes.popleft())
        with self._lock:
            readings: dict[str, tuple[InputReading, ...]] = {}
            for key, device in tuple(self._open.items()):
                try:
                    readings[key] = tuple(device.read())
                    self.arbiter.inform(key, streams=device.streams)
                except Exception as error:  # a plugin may raise anything; the device is then gone
                    self._drop(key, str(error))
                    self.hub.lost(key)
            intent = self.arbiter.step(readings, now_s)
            snapshot = InputSnapshot(intent, self.arbiter.received)
            if self._changed or now_s - self._view.host_time_s >= VIEW_S:
                self._changed, self._view = False, self._viewed(now_s)
            listeners = self._listeners
        for tell in listeners:
            tell(snapshot)
        return snapshot

    def open_mapping(self) -> None:
        """Send nothing but stops from now on: mappings are made, or sticks calibrated."""
        with self._lock:
            self.arbiter.open_mapping()
            self._changed = True

    def close_mapping(self) -> None:
        """Send again, after every stick was seen at rest."""
        with self._lock:
            self.arbiter.close_mapping()
            self._changed = True

    def rumble(self, strength: float) -> None:
        """Let the devices that can shake with a strength of 0 to 1."""
        with self._lock:
            for key, device in tuple(self._open.items()):
                if not isinstance(device, Rumbler):
                    continue
                try:
                    device.rumble(strength)
                except Exception as error:  # as in reading
                    self._drop(key, str(error))
                    self.hub.lost(key)

    def device(self, key: str) -> InputDevice | None:
        """Return an open device, to be told apart by its names; only ``step`` reads it."""
        with self._lock:
            return self._open.get(key)

    def close(self) -> None:
        """Release every device."""
        with self._lock:
            for key in tuple(self._open):
                self._drop(key, marked("engine", "the program releases it"))

    # --- inside -----------------------------------------------------------------------------------

    def _viewed(self, now_s: float) -> DevicesView:
        arbiter = self.arbiter
        return DevicesView(
            now_s,
            arbiter.views,
            arbiter.driving,
            arbiter.mapping_open,
            self.profile,
            arbiter.problems,
        )

    def _follow(self, changes: Changes) -> None:
        for identity in changes.left:
            self._drop(identity.key, "unplugged")
        for identity in changes.arrived:
            self._drop(identity.key, "replugged")
            try:
                device = self.hub.open(identity.key)
            except DriverError as error:  # kept among the problems by the hub
                _LOG.warning("%s", error)
                continue
            calibration = self.calibrations.load(identity)
            with self._lock:
                self._open[identity.key] = device
                self.arbiter.plug(_plugged(device), calibration)
        with self._lock:
            if self._chosen is None:
                self._use_automatic()

    def _drop(self, key: str, why: str) -> None:
        with self._lock:
            device = self._open.pop(key, None)
            if device is None:
                return
            self.arbiter.unplug(key, why)
            try:
                device.close()
            except Exception:  # it has gone, and closing is all that is left to do
                _LOG.warning("%s cannot be closed", device.identity.name, exc_info=True)
            if self._chosen is None:
                self._use_automatic()

    def _use_automatic(self, anew: bool = False) -> None:
        """Use what the user has kept for these devices, or else what their controls suggest.

        What is used now stays if it fits, unless one is to be found ``again``.
        """
        plugged = tuple(_plugged(device) for device in self._open.values())
        if not anew and self.profile is not None and _fits(self.profile, plugged):
            return
        kept = (listed.profile for listed in self.profiles if listed.profile is not None)
        for profile in (*kept, automatic_profile(plugged)):
            if profile is None or not _fits(profile, plugged):
                continue
            try:
                self._hand_to_arbiter(profile)
            except ProfileError as error:
                _LOG.warning("%s", error)
                continue
            return

    def _hand_to_arbiter(self, profile: Profile) -> None:
        self.arbiter.use(profile)
        self.profile = profile


def automatic_profile(devices: Iterable[PluggedDevice]) -> Profile | None:
    """Return a profile of the connected devices; the first drives, the pad may take over.

    None where no device has anything that could be mapped.
    """
    mappings: list[DeviceMapping] = []
    ordered = sorted(devices, key=_rank)
    for device in ordered:
        if mappings and device.identity.source != _PAD:
            continue
        try:
            (mapping,) = default_profile(device).devices
        except ProfileError:
            continue
        mappings.append(
            replace(mapping, seat=OperatorRole.TRAINEE if mappings else OperatorRole.TRAINER)
        )
    return Profile(name="Automatic", devices=tuple(mappings)) if mappings else None


def _fits(profile: Profile, plugged: tuple[PluggedDevice, ...]) -> bool:
    """Whether every device of a profile is there, and no better one is left out."""
    used = assigned(profile, plugged)
    if len(used) != len(profile.devices):
        return False
    best = min(_rank(one) for one in plugged)
    return any(_rank(one) == best for one in plugged if one.identity.key in used)


def _rank(device: PluggedDevice) -> int:
    return _RANKS.get(device.identity.source, 0)


def _plugged(device: InputDevice) -> PluggedDevice:
    return PluggedDevice(device.identity, device.axes, device.buttons, device.streams)
