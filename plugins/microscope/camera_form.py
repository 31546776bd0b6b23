"""Conversion of typed camera settings."""

from dataclasses import dataclass

from rotemina.drivers.cameras.errors import CameraSettingError
from rotemina.drivers.cameras.frame import Region
from rotemina.drivers.cameras.settings import CameraDescription, CameraSettings, PixelType, Trigger
from rotemina.plugins.microscope import mark, tr
from rotemina.sim.quantities import parsed, rounded

WHOLE = mark("whole")


@dataclass(frozen=True, slots=True)
class CameraTexts:
    """As typed and chosen: exposure in ms; empty leaves the camera as it is."""

    exposure: str = ""
    gain: str = ""
    rate: str = ""
    region: str = WHOLE
    pixel_type: str = ""
    trigger: str = Trigger.FREE.value
    repeat: bool = True


def texts_of(settings: CameraSettings) -> CameraTexts:
    """Return settings as they are typed."""
    exposure_s = settings.exposure_s
    return CameraTexts(
        exposure=_text(None if exposure_s is None else 1e3 * exposure_s),
        gain=_text(settings.gain),
        rate=_text(settings.rate_hz),
        region=region_text(settings.region),
        pixel_type=settings.pixel_type.value if settings.pixel_type is not None else "",
        trigger=settings.trigger.value,
        repeat=settings.repeat,
    )


def settings_of(texts: CameraTexts) -> CameraSettings:
    """Return what was typed as settings; whether the camera can do that is its own to say.

    Raises
    ------
    CameraSettingError
        If something is no number, or no region.
    """
    exposure_ms = _number(tr("exposure"), texts.exposure, "ms")
    return CameraSettings(
        exposure_s=None if exposure_ms is None else 1e-3 * exposure_ms,
        gain=_number(tr("gain"), texts.gain, ""),
        rate_hz=_number(tr("rate"), texts.rate, "Hz"),
        region=_region(texts.region),
        pixel_type=PixelType(texts.pixel_type) if texts.pixel_type else None,
        trigger=Trigger(texts.trigger),
        repeat=texts.repeat,
    )


def region_text(region: Region | None) -> str:
    """Return a region as it is typed."""
    if region is None:
        return tr(WHOLE)
    return f"{region.left} {region.top} {region.width} {region.height}"


def pixel_types(can: CameraDescription) -> tuple[PixelType, ...]:
    """Return what can be chosen; 8 bits are made of everything."""
    return tuple(dict.fromkeys((*can.pixel_types, PixelType.MONO8)))


def bounds_text(bounds: tuple[float, float] | None, scale: float, unit: str) -> str:
    """Return what may be typed, in words."""
    if bounds is None:
        return tr("this camera has no such setting")
    return (
        tr("{low:g} to {high:g} {unit}")
        .format(low=scale * bounds[0], high=scale * bounds[1], unit=unit)
        .rstrip()
    )


def _text(value: float | None) -> str:
    return "" if value is None else rounded(value, 6)


def _number(name: str, text: str, unit: str) -> float | None:
    if not text.strip():
        return None
    number = parsed(text)
    if number is None:
        raise CameraSettingError(
            tr("{name}: {text!r} is not a number; enter one in {unit}").format(
                name=name, text=text.strip(), unit=unit or "1"
            )
        )
    return number


def _region(text: str) -> Region | None:
    plain = text.strip().lower()
    if plain in ("", WHOLE, tr(WHOLE)):
        return None
    parts = plain.replace(",", " ").replace("×", " ").split()
    if len(parts) != 4 or not all(part.isdecimal() and len(part) < 7 for part in parts):
        raise CameraSettingError(
            tr(
                "region: {text!r} is not valid; enter {whole}, or four integers: first "
                "column, first row, width and height, px"
            ).format(text=text.strip(), whole=tr(WHOLE))
        )
    return Region(*map(int, parts))
