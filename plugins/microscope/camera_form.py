"""Conversion between camera settings and the texts of the form."""

from dataclasses import dataclass

from rotemina.drivers.cameras import (
    CameraDescription,
    CameraSettings,
    CameraTrigger,
    PixelType,
    SensorRegion,
)
from rotemina.drivers.contract import CameraSettingError
from rotemina.plugins.microscope import mark, tr
from rotemina.sim.messages import format_rounded, parse_number

WHOLE_SENSOR = mark("whole")


@dataclass(frozen=True, slots=True)
class CameraTexts:
    """Camera settings as typed and chosen.

    The exposure is in ms. An empty text leaves the setting of the camera unchanged.
    """

    exposure: str = ""
    gain: str = ""
    rate: str = ""
    region: str = WHOLE_SENSOR
    pixel_type: str = ""
    trigger: str = CameraTrigger.FREE.value
    repeat: bool = True


def to_camera_texts(settings: CameraSettings) -> CameraTexts:
    """Return camera settings as texts for the form."""
    exposure_s = settings.exposure_s
    return CameraTexts(
        exposure=_format_number(None if exposure_s is None else 1e3 * exposure_s),
        gain=_format_number(settings.gain),
        rate=_format_number(settings.rate_hz),
        region=format_region(settings.region),
        pixel_type=settings.pixel_type.value if settings.pixel_type is not None else "",
        trigger=settings.trigger.value,
        repeat=settings.repeat,
    )


def to_camera_settings(texts: CameraTexts) -> CameraSettings:
    """Return the camera settings that the texts of the form describe.

    The camera itself checks later whether it supports the values.

    Raises
    ------
    CameraSettingError
        If a text is not a number, or the region is not valid.
    """
    exposure_ms = _parse_number(tr("exposure"), texts.exposure, "ms")
    return CameraSettings(
        exposure_s=None if exposure_ms is None else 1e-3 * exposure_ms,
        gain=_parse_number(tr("gain"), texts.gain, ""),
        rate_hz=_parse_number(tr("rate"), texts.rate, "Hz"),
        region=_parse_region(texts.region),
        pixel_type=PixelType(texts.pixel_type) if texts.pixel_type else None,
        trigger=CameraTrigger(texts.trigger),
        repeat=texts.repeat,
    )


def format_region(region: SensorRegion | None) -> str:
    """Return the text of a region: first column, first row, width and height, px."""
    if region is None:
        return tr(WHOLE_SENSOR)
    return f"{region.left} {region.top} {region.width} {region.height}"


def list_pixel_types(description: CameraDescription) -> tuple[PixelType, ...]:
    """Return the pixel types to choose from.

    8 bits are always among them because the program converts every other type to them.
    """
    return tuple(dict.fromkeys((*description.pixel_types, PixelType.MONO8)))


def format_bounds(bounds: tuple[float, float] | None, scale: float, unit: str) -> str:
    """Return the permitted range of a setting as text."""
    if bounds is None:
        return tr("this camera has no such setting")
    return (
        tr("{low:g} to {high:g} {unit}")
        .format(low=scale * bounds[0], high=scale * bounds[1], unit=unit)
        .rstrip()
    )


def _format_number(value: float | None) -> str:
    return "" if value is None else format_rounded(value, 6)


def _parse_number(name: str, text: str, unit: str) -> float | None:
    if not text.strip():
        return None
    number = parse_number(text)
    if number is None:
        raise CameraSettingError(
            tr("{name}: {text!r} is not a number; enter one in {unit}").format(
                name=name, text=text.strip(), unit=unit or "1"
            )
        )
    return number


def _parse_region(text: str) -> SensorRegion | None:
    cleaned = text.strip().lower()
    if cleaned in ("", WHOLE_SENSOR, tr(WHOLE_SENSOR)):
        return None
    parts = cleaned.replace(",", " ").replace("×", " ").split()
    if len(parts) != 4 or not all(part.isdecimal() and len(part) < 7 for part in parts):
        raise CameraSettingError(
            tr(
                "region: {text!r} is not valid; enter {whole}, or four integers: first "
                "column, first row, width and height, px"
            ).format(text=text.strip(), whole=tr(WHOLE_SENSOR))
        )
    return SensorRegion(*map(int, parts))
