"""The last used camera and its settings, stored in the preferences."""

import logging
from dataclasses import dataclass

from pydantic import TypeAdapter, ValidationError

from rotemina.app.settings import UserSettings
from rotemina.drivers.cameras import CameraIdentity, CameraSettings

logger = logging.getLogger(__name__)

LAST_CAMERA_KEY = "microscope.camera"


@dataclass(frozen=True, slots=True)
class RememberedCamera:
    """A camera and its current settings.

    ``by_address`` means that the camera was opened by its address because no search finds it.
    """

    identity: CameraIdentity
    settings: CameraSettings
    by_address: bool = False


_ADAPTER = TypeAdapter(RememberedCamera)


class CameraMemory:
    """Memory of the last used camera, read once and written whenever the camera changes.

    Parameters
    ----------
    settings : UserSettings, optional
        Preferences; without them the camera is forgotten when the program ends.
    """

    def __init__(self, settings: UserSettings | None = None) -> None:
        self._settings = settings
        self.last_camera: RememberedCamera | None = self._read()

    def store(self, camera: RememberedCamera | None) -> None:
        """Remember a camera; None means that no camera is in use."""
        if camera == self.last_camera:
            return
        self.last_camera = camera
        if self._settings is not None:
            text = "" if camera is None else _ADAPTER.dump_json(camera).decode()
            self._settings.set(LAST_CAMERA_KEY, text)

    def _read(self) -> RememberedCamera | None:
        text = "" if self._settings is None else self._settings.get(LAST_CAMERA_KEY, "")
        if not text:
            return None
        try:
            return _ADAPTER.validate_json(text)
        except ValidationError as error:
            logger.warning("preference %s is ignored: %s", LAST_CAMERA_KEY, error)
            return None
