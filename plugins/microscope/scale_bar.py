"""A scale bar of a round length."""

from typing import NamedTuple

from rotemina.app.microscope.status import ScaleSource
from rotemina.app.widgets.tip_frame import round_down, round_length
from rotemina.plugins.microscope import tr
from rotemina.sim.quantities import rounded

_WIDEST = 0.3  # of the widget


class Bar(NamedTuple):
    """Its length on the screen, px, and what is written beside it."""

    length: float
    text: str
    remark: str = ""


def scale_bar(pixel_m: float | None, source: ScaleSource, zoom: float, width: float) -> Bar:
    """Return a bar of at most 30 % of ``width``, screen px; in pixels where no size is known."""
    room = _WIDEST * width / zoom
    if pixel_m is None:
        count = max(round_down(room), 1.0)
        return Bar(count * zoom, f"{rounded(count, 6)} px", tr("not calibrated"))
    length_m, text = round_length(room * pixel_m)
    remark = tr("from the robot file") if source is ScaleSource.ROBOT_FILE else ""
    return Bar(length_m / pixel_m * zoom, text, remark)
