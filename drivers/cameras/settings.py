"""Camera settings and capabilities, and their check against each other."""

from dataclasses import dataclass
from enum import StrEnum
from math import isfinite

from rotemina.drivers.cameras.errors import CameraSettingError
from rotemina.drivers.cameras.frame import Region
from rotemina.sim.messages import message


class PixelType(StrEnum):
    """The type of a pixel."""

    MONO8 = "mono8"
    MONO16 = "mono16"
    COLOUR = "colour"


class Trigger(StrEnum):
    """What makes the camera take a picture."""

    FREE = "free-running"
    SOFTWARE = "software"


@dataclass(frozen=True, slots=True)
class CameraSettings:
    """Requested camera settings; None leaves the camera's own.

    Attributes
    ----------
    exposure_s, gain, rate_hz : float or None
    region : Region or None
        None: the whole sensor.
    pixel_type : PixelType or None
        None: the first of what the camera has.
    trigger : Trigger
    repeat : bool
        Whether a file or sequence begins again at its end; without meaning for a device.
    """

    exposure_s: float | None = None
    gain: float | None = None
    rate_hz: float | None = None
    region: Region | None = None
    pixel_type: PixelType | None = None
    trigger: Trigger = Trigger.FREE
    repeat: bool = True


@dataclass(frozen=True, slots=True)
class CameraDescription:
    """What an open camera can do.

    Attributes
    ----------
    width, height : int
        Of the sensor, px.
    pixel_types : tuple of PixelType
        What it has itself; ``MONO8`` is made of every other.
    triggers : tuple of Trigger
    exposure_s, gain, rate_hz : (least, greatest) or None
        None: it cannot be set.
    noise_free : bool
        Whether two pictures may be equal because they are drawn or come from files. The noise of a
        sensor never gives the same picture twice: one that repeats pictures is frozen.
    """

    width: int
    height: int
    pixel_types: tuple[PixelType, ...]
    triggers: tuple[Trigger, ...] = (Trigger.FREE,)
    exposure_s: tuple[float, float] | None = None
    gain: tuple[float, float] | None = None
    rate_hz: tuple[float, float] | None = None
    noise_free: bool = False

    @property
    def whole(self) -> Region:
        """The region that is all of the sensor."""
        return Region(0, 0, self.width, self.height)


def check(name: str, can: CameraDescription, settings: CameraSettings) -> None:
    """Refuse what the camera called ``name`` cannot do.

    Raises
    ------
    CameraSettingError
        Naming the setting, its value and what it may be.
    """
    for what, unit in (("exposure_s", " s"), ("gain", ""), ("rate_hz", " Hz")):
        _check_number(name, what, unit, getattr(settings, what), getattr(can, what))
    types = (*can.pixel_types, PixelType.MONO8)
    if settings.pixel_type is not None and settings.pixel_type not in types:
        known = ", ".join(dict.fromkeys(types))
        raise CameraSettingError(
            message("engine", "{name} has no pixel type {pixel_type}; available: {known}").fill(
                name=name, pixel_type=settings.pixel_type, known=known
            )
        )
    if settings.trigger not in can.triggers:
        known = ", ".join(can.triggers)
        raise CameraSettingError(
            message("engine", "{name} has no trigger {trigger}; available: {known}").fill(
                name=name, trigger=settings.trigger, known=known
            )
        )
    if settings.region is not None:
        _check_region(name, can, settings.region)


def _check_number(
    name: str, what: str, unit: str, value: float | None, bounds: tuple[float, float] | None
) -> None:
    if value is None:
        return
    if bounds is None:
        raise CameraSettingError(
            message(
                "engine", "{name}: {what} = {value}{unit}: cannot be set; leave it unchanged"
            ).fill(name=name, what=what, value=value, unit=unit)
        )
    if not (isfinite(value) and bounds[0] <= value <= bounds[1]):
        raise CameraSettingError(
            message(
                "engine", "{name}: {what} = {value}{unit}: must be {least} to {most}{unit}"
            ).fill(name=name, what=what, value=value, unit=unit, least=bounds[0], most=bounds[1])
        )


def _check_region(name: str, can: CameraDescription, region: Region) -> None:
    right, bottom = region.left + region.width, region.top + region.height
    inside = region.left >= 0 and region.top >= 0 and right <= can.width and bottom <= can.height
    if not (inside and region.width > 0 and region.height > 0):
        raise CameraSettingError(
            message(
                "engine",
                "{name}: region of {width} × {height} px from column {left}, row {top}: must lie "
                "in the sensor's {can_width} × {can_height} px",
            ).fill(
                name=name,
                width=region.width,
                height=region.height,
                left=region.left,
                top=region.top,
                can_width=can.width,
                can_height=can.height,
            )
        )
