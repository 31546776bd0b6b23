"""Camera settings and capabilities, and the check of settings against capabilities."""

from dataclasses import dataclass
from enum import StrEnum
from math import isfinite
from typing import TYPE_CHECKING

from rotemina.drivers.cameras.frame import PixelType, SensorRegion
from rotemina.drivers.contract import CameraSettingError
from rotemina.sim.compatibility import FormerMember, serve_former_names


class CameraTrigger(StrEnum):
    """The trigger that makes a camera take a picture."""

    FREE = "free-running"
    SOFTWARE = "software"


@dataclass(frozen=True, slots=True)
class CameraSettings:
    """Requested settings of a camera. None leaves a setting of the camera unchanged.

    Attributes
    ----------
    exposure_s, gain, rate_hz : float or None
    region : SensorRegion or None
        None means the whole sensor.
    pixel_type : PixelType or None
        None means the camera's first pixel type.
    trigger : CameraTrigger
    repeat : bool
        Whether a file or sequence starts again at its end. It has no effect on a device.
    """

    exposure_s: float | None = None
    gain: float | None = None
    rate_hz: float | None = None
    region: SensorRegion | None = None
    pixel_type: PixelType | None = None
    trigger: CameraTrigger = CameraTrigger.FREE
    repeat: bool = True


@dataclass(frozen=True, slots=True)
class CameraDescription:
    """Capabilities of an open camera.

    Attributes
    ----------
    width, height : int
        Size of the sensor, px.
    pixel_types : tuple of PixelType
        Types that the camera provides without conversion. All can be converted to ``MONO8``.
    triggers : tuple of CameraTrigger
    exposure_s, gain, rate_hz : (min, max) or None
        Ranges; None if the setting cannot be changed.
    noise_free : bool
        Whether two pictures may be equal, because they are computed or come from files. A real
        sensor has noise and never repeats a picture, so equal pictures mean a frozen camera.
    """

    width: int
    height: int
    pixel_types: tuple[PixelType, ...]
    triggers: tuple[CameraTrigger, ...] = (CameraTrigger.FREE,)
    exposure_s: tuple[float, float] | None = None
    gain: tuple[float, float] | None = None
    rate_hz: tuple[float, float] | None = None
    noise_free: bool = False

    @property
    def full_region(self) -> SensorRegion:
        """The region of the whole sensor."""
        return SensorRegion(0, 0, self.width, self.height)

    # Former names, which work for one more release.
    whole = FormerMember("full_region")


def check_settings(name: str, description: CameraDescription, settings: CameraSettings) -> None:
    """Check that the camera called ``name`` supports the settings.

    Raises
    ------
    CameraSettingError
        If it does not; the message contains the setting, its value and the supported values.
    """
    for setting, unit in (("exposure_s", " s"), ("gain", ""), ("rate_hz", " Hz")):
        value, bounds = getattr(settings, setting), getattr(description, setting)
        _check_number(name, setting, unit, value, bounds)
    types = (*description.pixel_types, PixelType.MONO8)
    if settings.pixel_type is not None and settings.pixel_type not in types:
        available = ", ".join(dict.fromkeys(types))
        raise CameraSettingError(
            "{name} has no pixel type {pixel_type}; available: {known}",
            name=name,
            pixel_type=settings.pixel_type,
            known=available,
        )
    if settings.trigger not in description.triggers:
        available = ", ".join(description.triggers)
        raise CameraSettingError(
            "{name} has no trigger {trigger}; available: {known}",
            name=name,
            trigger=settings.trigger,
            known=available,
        )
    if settings.region is not None:
        _check_region(name, description, settings.region)


def _check_number(
    name: str, setting: str, unit: str, value: float | None, bounds: tuple[float, float] | None
) -> None:
    if value is None:
        return
    if bounds is None:
        raise CameraSettingError(
            "{name}: {what} = {value}{unit}: cannot be set; leave it unchanged",
            name=name,
            what=setting,
            value=value,
            unit=unit,
        )
    if not (isfinite(value) and bounds[0] <= value <= bounds[1]):
        raise CameraSettingError(
            "{name}: {what} = {value}{unit}: must be {least} to {most}{unit}",
            name=name,
            what=setting,
            value=value,
            unit=unit,
            least=bounds[0],
            most=bounds[1],
        )


def _check_region(name: str, description: CameraDescription, region: SensorRegion) -> None:
    right, bottom = region.left + region.width, region.top + region.height
    is_inside = (
        region.left >= 0
        and region.top >= 0
        and right <= description.width
        and bottom <= description.height
    )
    if not (is_inside and region.width > 0 and region.height > 0):
        raise CameraSettingError(
            "{name}: region of {width} × {height} px from column {left}, row {top}: must lie "
            "within the sensor's {can_width} × {can_height} px",
            name=name,
            width=region.width,
            height=region.height,
            left=region.left,
            top=region.top,
            can_width=description.width,
            can_height=description.height,
        )


if not TYPE_CHECKING:
    __getattr__ = serve_former_names(
        __name__,
        Trigger="CameraTrigger",
        check="check_settings",
    )
