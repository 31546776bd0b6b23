"""Texts about the pixel under the cursor, and about a measured line."""

from math import degrees

import numpy as np

from rotemina.app.microscope import MeasuredLine, MicroscopeStatus, compute_tip_xy
from rotemina.drivers.cameras import CameraFrame
from rotemina.plugins.microscope import tr
from rotemina.sim.messages import format_fixed
from rotemina.sim.units import format_exact


def describe_cursor(status: MicroscopeStatus, pixel: tuple[float, float] | None) -> str:
    """Return pixel, value and position under the cursor; empty if it is outside the picture."""
    frame = status.feed.frame
    if frame is None or pixel is None:
        return ""
    column, row = round(pixel[0]), round(pixel[1])
    rows, columns = frame.pixels.shape[:2]
    if not (0 <= column < columns and 0 <= row < rows):
        return ""
    parts = [f"{column}, {row} px", format_pixel_value(frame, column, row)]
    calibration = status.calibration.micro if status.calibration is not None else None
    if calibration is not None:
        # The result is the position of a tip at this pixel. A cursor has no uncertainty.
        position_m, _ = compute_tip_xy(
            np.array(pixel), covariance=np.zeros((2, 2)), calibration=calibration
        )
        parts.append(
            f"x {format_fixed(1e6 * position_m[0], 2)}, y {format_fixed(1e6 * position_m[1], 2)} µm"
        )
    elif status.pixel_m is not None:
        across, down = (1e6 * status.pixel_m * coordinate for coordinate in pixel)
        parts.append(
            tr("{across:.1f}, {down:.1f} µm from the corner").format(across=across, down=down)
        )
    return "   ".join(parts)


def format_pixel_value(frame: CameraFrame, column: int, row: int) -> str:
    """Return the value of a pixel and the largest possible value, or red, green and blue."""
    value = frame.pixels[row, column]
    if frame.is_colour:
        return "RGB " + " ".join(str(int(channel)) for channel in value)
    return tr("{number} of {largest}").format(number=int(value), largest=frame.saturation_value)


def format_measurement(line: MeasuredLine) -> str:
    """Return length and angles of a measured line."""
    length = f"{format_fixed(line.length_px, 1)} px"
    if line.length_m is not None:
        length = f"{format_exact(line.length_m, 'm')} ({length})"
    text = f"{length}, {format_fixed(degrees(line.angle), 1)}°"
    if line.angle_to_pipette is not None:
        text += tr(", {angle:.1f}° to the pipette").format(angle=degrees(line.angle_to_pipette))
    return text
