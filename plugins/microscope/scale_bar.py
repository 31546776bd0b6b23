"""A scale bar of a round length."""

from math import floor, log10
from typing import NamedTuple

from rotemina.app.microscope.status import ScaleSource
from rotemina.plugins.microscope import tr
from rotemina.sim.quantities import rounded

_WIDEST = 0.3  # of the widget
_STEPS = (5.0, 2.0, 1.0)
_UNITS = ((1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"))


class Bar(NamedTuple):
    """Its length on the screen, px, and what is written beside it."""

    length: float
    text: str
    remark: str = ""


def scale_bar(pixel_m: float | None, source: ScaleSource, zoom: float, width: float) -> Bar:
    """Return a bar of at most 30 % of ``width``, screen px; in pixels where no size is known."""
    room = _WIDEST * width / zoom
    if pixel_m is None:
        count = max(_round_down(room), 1.0)
        return Bar(count * zoom, f"{rounded(count, 6)} px", tr("not calibrated"))
    length_m = _round_down(room * pixel_m)
    unit, name = next((one for one in _UNITS if length_m >= 0.9999 * one[0]), _UNITS[-1])
    remark = tr("from the robot file") if source is ScaleSource.ROBOT_FILE else ""
    return Bar(length_m / pixel_m * zoom, f"{rounded(length_m / unit)} {name}", remark)


def _round_down(value: float) -> float:
    """Return the greatest 1, 2 or 5 times a power of ten that is not more."""
    power = 10.0 ** floor(log10(value))
    return next(step * power for step in _STEPS if step * power <= value * (1 + 1e-12))
