"""The operator's input devices: discovers, opens and reads them, and returns one intent."""

import logging
import threading
from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from rotemina.app.errors import InputProfileError
from rotemina.app.motion.inputs.axis_calibration import (
    InputCalibration,
    InputCalibrationFolder,
)
from rotemina.app.motion.inputs.default_profile import make_default_profile
from rotemina.app.motion.inputs.input_arbiter import InputArbiter, InputDisplayState
from rotemina.app.motion.inputs.intent import Intent
from rotemina.app.motion.inputs.profile import (
    DeviceMapping,
    InputProfile,
    ListedProfile,
    OperatorRole,
    list_profiles,
    save_profile,
)
from rotemina.app.motion.inputs.profile_check import PluggedDevice, assign_mappings
from rotemina.drivers.contract import DriverError
from rotemina.drivers.inputs import (
    InputChanges,
    InputDevice,
    InputHub,
    InputReading,
    RumbleDevice,
)
from rotemina.sim.messages import marked

# Period at which the view is updated. Screens need no faster updates.
VIEW_PERIOD_S = 1.0 / 30.0

_LOG = logging.getLogger(__name__)
# Source of the on-screen pad.
_PAD_SOURCE = "keys"
# These sources are always present, even if nobody uses them, so all others take precedence.
_SOURCE_RANKS = {"board": 1, _PAD_SOURCE: 2}


@dataclass(frozen=True, slots=True)
class InputSnapshot:
    """Readings of all devices in one step, and the resulting intent.

    Attributes
    ----------
    intent : Intent
    readings : mapping of str to tuple of InputReading
        Readings since the previous step by device key.
    """

    intent: Intent
    readings: Mapping[str, tuple[InputReading, ...]]


class InputDevices:
    """Keeps all plugged input devices open, and reads them for the input arbiter.

    :meth:`detect_changes` may take some ms. Call it about once a second from a separate thread.
    Call :meth:`step` from the thread that steers. Everything else may be called from any thread.

    Parameters
    ----------
    hub : InputHub
    robot_axes : sequence of str
    folder : Path
        Folder with the user's ``calibrations`` and ``profiles``.
    """

    def __init__(self, hub: InputHub, robot_axes: Sequence[str], folder: Path) -> None:
        self.hub = hub
        self.arbiter = InputArbiter(robot_axes)
        self.calibrations = InputCalibrationFolder(folder / "calibrations")
        self._profile_folder = folder / "profiles"
        # Profile that the operator has chosen; None stands for an automatic profile.
        self._chosen_profile: InputProfile | None = None
        #: The profile in use, or None.
        self.profile: InputProfile | None = None
        self._open_devices: dict[str, InputDevice] = {}
        self._pending_changes: deque[InputChanges] = deque()
        self._listeners: tuple[Callable[[InputSnapshot], None], ...] = ()
        self._view = InputDisplayState()
        # Whether a request has changed something that is not in the view yet.
        self._is_view_outdated = True
        # Guards the arbiter and the open devices. It is held during a step, and never while a
        # device is being opened.
        self._lock = threading.RLock()

    @property
    def profiles(self) -> tuple[ListedProfile, ...]:
        """The user's saved profiles. An invalid profile is listed with its problem."""
        return list_profiles(self._profile_folder)

    def use_profile(self, profile: InputProfile | None) -> None:
        """Use a profile; None selects an automatic profile for the plugged devices.

        Raises
        ------
        InputProfileError
            See :meth:`InputArbiter.use_profile`. The previous profile then stays in use.
        """
        with self._lock:
            if profile is not None:
                self._use_in_arbiter(profile)
            self._chosen_profile = profile
            self._is_view_outdated = True
            if profile is None:
                self._choose_profile(force_new=True)

    def save_profile(self, profile: InputProfile) -> Path:
        """Write a profile into the user's folder, and return its path.

        Raises
        ------
        FileWriteError
            If the profile cannot be written.
        """
        return save_profile(self._profile_folder, profile)

    def use_calibration(self, key: str, calibration: InputCalibration) -> None:
        """Use and save another calibration of a plugged device.

        Raises
        ------
        InputCalibrationError, FileWriteError
            If the calibration belongs to another device, the device is not plugged in, or the file
            cannot be written.
        """
        with self._lock:
            self.arbiter.use_calibration(key, calibration)
            self._is_view_outdated = True
            device = self._open_devices.get(key)
        if device is not None:
            self.calibrations.save(device.identity, calibration)

    @property
    def view(self) -> InputDisplayState:
        """State for display, at most :data:`VIEW_PERIOD_S` old. Reading it never waits.

        :attr:`InputHub.problems` lists sources and devices that cannot be used.
        """
        return self._view

    def add_listener(self, listener: Callable[[InputSnapshot], None]) -> Callable[[], None]:
        """Call ``listener`` after every step, on the thread of the step.

        Return the function that removes it. ``listener`` must neither wait nor raise; the ``put``
        of a queue is suitable.
        """
        with self._lock:
            self._listeners = (*self._listeners, listener)

        def remove() -> None:
            with self._lock:
                self._listeners = tuple(other for other in self._listeners if other is not listener)

        return remove

    def detect_changes(self) -> None:
        """Detect devices that were plugged in or removed. The next step handles them."""
        changes = self.hub.poll()
        if changes.added or changes.removed:
            self._pending_changes.append(changes)

    def step(self, now_s: float) -> InputSnapshot:
        """Read all devices, without waiting, and return the resulting intent."""
        while self._pending_changes:
            self._apply_changes(self._pending_changes.popleft())
        with self._lock:
            readings: dict[str, tuple[InputReading, ...]] = {}
            for key, device in tuple(self._open_devices.items()):
                try:
                    readings[key] = tuple(device.read())
                    self.arbiter.set_streaming(key, streams=device.streams)
                # A plugin may raise any exception. The device then counts as removed.
                except Exception as error:
                    self._close_device(key, str(error))
                    self.hub.note_loss(key)
            intent = self.arbiter.step(readings, now_s)
            snapshot = InputSnapshot(intent, self.arbiter.latest_readings)
            if self._is_view_outdated or now_s - self._view.host_time_s >= VIEW_PERIOD_S:
                self._is_view_outdated, self._view = False, self._make_view(now_s)
            listeners = self._listeners
        for listener in listeners:
            listener(snapshot)
        return snapshot

    def open_mapping(self) -> None:
        """Pass on only stops from now on, while mappings are made or sticks are calibrated."""
        with self._lock:
            self.arbiter.open_mapping()
            self._is_view_outdated = True

    def close_mapping(self) -> None:
        """Pass on everything again, once each axis has been at rest."""
        with self._lock:
            self.arbiter.close_mapping()
            self._is_view_outdated = True

    def rumble(self, strength: float) -> None:
        """Rumble with a strength of 0 to 1 on all devices that support it."""
        with self._lock:
            for key, device in tuple(self._open_devices.items()):
                if not isinstance(device, RumbleDevice):
                    continue
                try:
                    device.rumble(strength)
                # As in reading, a plugin may raise any exception.
                except Exception as error:
                    self._close_device(key, str(error))
                    self.hub.note_loss(key)

    def find_device(self, key: str) -> InputDevice | None:
        """Return an open device by its key, or None. Only :meth:`step` may read from it."""
        with self._lock:
            return self._open_devices.get(key)

    def close(self) -> None:
        """Release every device."""
        with self._lock:
            for key in tuple(self._open_devices):
                self._close_device(key, marked("engine", "the program releases it"))

    def _make_view(self, now_s: float) -> InputDisplayState:
        arbiter = self.arbiter
        return InputDisplayState(
            now_s,
            arbiter.device_views,
            arbiter.driving_seat,
            arbiter.is_mapping_open,
            self.profile,
            arbiter.problems,
        )

    def _apply_changes(self, changes: InputChanges) -> None:
        for identity in changes.removed:
            self._close_device(identity.key, "unplugged")
        for identity in changes.added:
            self._close_device(identity.key, "replugged")
            try:
                device = self.hub.open(identity.key)
            # The hub lists the error among its problems.
            except DriverError as error:
                _LOG.warning("%s", error)
                continue
            calibration = self.calibrations.load_or_default(identity)
            with self._lock:
                self._open_devices[identity.key] = device
                self.arbiter.plug(_to_plugged_device(device), calibration)
        with self._lock:
            if self._chosen_profile is None:
                self._choose_profile()

    def _close_device(self, key: str, reason: str) -> None:
        with self._lock:
            device = self._open_devices.pop(key, None)
            if device is None:
                return
            self.arbiter.unplug(key, reason)
            try:
                device.close()
            # The device is already removed, so it does not matter if closing fails.
            except Exception:
                _LOG.warning("%s cannot be closed", device.identity.name, exc_info=True)
            if self._chosen_profile is None:
                self._choose_profile()

    def _choose_profile(self, force_new: bool = False) -> None:
        """Use the first saved profile that fits the devices, or else an automatic one.

        The current profile stays in use if it fits, unless ``force_new``.
        """
        plugged_devices = tuple(
            _to_plugged_device(device) for device in self._open_devices.values()
        )
        if (
            not force_new
            and self.profile is not None
            and _is_best_fit(self.profile, plugged_devices)
        ):
            return
        saved_profiles = (listed.profile for listed in self.profiles if listed.profile is not None)
        for profile in (*saved_profiles, make_automatic_profile(plugged_devices)):
            if profile is None or not _is_best_fit(profile, plugged_devices):
                continue
            try:
                self._use_in_arbiter(profile)
            except InputProfileError as error:
                _LOG.warning("%s", error)
                continue
            return

    def _use_in_arbiter(self, profile: InputProfile) -> None:
        self.arbiter.use_profile(profile)
        self.profile = profile


def make_automatic_profile(devices: Iterable[PluggedDevice]) -> InputProfile | None:
    """Return a profile in which the first device drives and the pad may take over.

    Return None if no device has a control that can be mapped.
    """
    mappings: list[DeviceMapping] = []
    devices_by_rank = sorted(devices, key=_find_rank)
    for device in devices_by_rank:
        if mappings and device.identity.source != _PAD_SOURCE:
            continue
        try:
            (mapping,) = make_default_profile(device).devices
        except InputProfileError:
            continue
        mappings.append(
            replace(mapping, seat=OperatorRole.TRAINEE if mappings else OperatorRole.TRAINER)
        )
    return InputProfile(name="Automatic", devices=tuple(mappings)) if mappings else None


def _is_best_fit(profile: InputProfile, plugged_devices: tuple[PluggedDevice, ...]) -> bool:
    """Return whether all devices of a profile are plugged in, and one of them has the best rank."""
    mappings = assign_mappings(profile, plugged_devices)
    if len(mappings) != len(profile.devices):
        return False
    best_rank = min(_find_rank(device) for device in plugged_devices)
    return any(
        _find_rank(device) == best_rank
        for device in plugged_devices
        if device.identity.key in mappings
    )


def _find_rank(device: PluggedDevice) -> int:
    return _SOURCE_RANKS.get(device.identity.source, 0)


def _to_plugged_device(device: InputDevice) -> PluggedDevice:
    return PluggedDevice(device.identity, device.axes, device.buttons, device.streams)
