"""Values under the cursor, and angles and lengths as text."""

from math import degrees

import numpy as np

from rotemina.app.microscope.measurements import tip_in_plane
from rotemina.app.microscope.status import Measured, MicroscopeStatus
from rotemina.drivers.cameras.frame import Frame
from rotemina.plugins.microscope import tr
from rotemina.sim.quantities import exact, fixed


def cursor_text(status: MicroscopeStatus, place: tuple[float, float] | None) -> str:
    """Return pixel, value and place of the cursor; empty where it is not over the picture."""
    frame = status.feed.frame
    if frame is None or place is None:
        return ""
    column, row = round(place[0]), round(place[1])
    rows, columns = frame.pixels.shape[:2]
    if not (0 <= column < columns and 0 <= row < rows):
        return ""
    parts = [f"{column}, {row} px", value_text(frame, column, row)]
    micro = status.calibration.micro if status.calibration is not None else None
    if micro is not None:
        place_m, _ = tip_in_plane(np.array(place), np.zeros((2, 2)), micro)
        parts.append(f"x {fixed(1e6 * place_m[0], 2)}, y {fixed(1e6 * place_m[1], 2)} µm")
    elif status.pixel_m is not None:
        across, down = (1e6 * status.pixel_m * one for one in place)
        parts.append(
            tr("{across:.1f}, {down:.1f} µm from the corner").format(across=across, down=down)
        )
    return "   ".join(parts)


def value_text(frame: Frame, column: int, row: int) -> str:
    """Return a pixel's number, or its three, of the largest possible."""
    value = frame.pixels[row, column]
    if frame.colour:
        return "RGB " + " ".join(str(int(one)) for one in value)
    return tr("{number} of {largest}").format(number=int(value), largest=frame.largest)


def measured_text(line: Measured) -> str:
    """Return length and angles of a drawn line."""
    length = f"{fixed(line.length_px, 1)} px"
    if line.length_m is not None:
        length = f"{exact(line.length_m, 'm')} ({length})"
    text = f"{length}, {fixed(degrees(line.angle), 1)}°"
    if line.to_body is not None:
        text += tr(", {angle:.1f}° to the pipette").format(angle=degrees(line.to_body))
    return text
