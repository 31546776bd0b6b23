"""The last used camera and its settings, stored among the preferences."""

import logging
from dataclasses import dataclass

from pydantic import TypeAdapter, ValidationError

from rotemina.app.settings import Settings
from rotemina.drivers.cameras.camera import CameraIdentity
from rotemina.drivers.cameras.settings import CameraSettings

logger = logging.getLogger(__name__)

KEY = "microscope.camera"


@dataclass(frozen=True, slots=True)
class UsedCamera:
    """A camera, what was in force, and whether it was named by its address: no list shows it."""

    identity: CameraIdentity
    settings: CameraSettings
    by_address: bool = False


_ADAPTER = TypeAdapter(UsedCamera)


class CameraMemory:
    """Read once, and written whenever something else is in use.

    Parameters
    ----------
    settings : Settings, optional
        Without them nothing outlives the program.
    """

    def __init__(self, settings: Settings | None = None) -> None:
        self._settings = settings
        self.last: UsedCamera | None = self._read()

    def keep(self, used: UsedCamera | None) -> None:
        """Remember a camera, or none."""
        if used == self.last:
            return
        self.last = used
        if self._settings is not None:
            text = "" if used is None else _ADAPTER.dump_json(used).decode()
            self._settings.set(KEY, text)

    def _read(self) -> UsedCamera | None:
        text = "" if self._settings is None else self._settings.get(KEY, "")
        if not text:
            return None
        try:
            return _ADAPTER.validate_json(text)
        except ValidationError as error:
            logger.warning("preference %s is ignored: %s", KEY, error)
            return None
