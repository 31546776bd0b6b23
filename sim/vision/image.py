"""Images for the computations: one plane of single precision."""

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from rotemina.sim.errors import VisionError

Image = NDArray[np.float32]

MIN_SIDE_PX = 16
# Weights of red, green and blue according to ITU-R BT.601.
_LUMA_WEIGHTS = np.array([0.299, 0.587, 0.114], dtype=np.float32)


def to_grey(image: NDArray[Any]) -> Image:
    """Return an image as one plane (rows, columns).

    The image has the shape (rows, columns) or (rows, columns, 3), with red, green and blue.

    Raises
    ------
    VisionError
        If the shape is not that of an image, it is too small or not finite, or all pixels have the
        same value (black or saturated).
    """
    array = np.asarray(image)
    if array.ndim == 3 and array.shape[2] == 3:
        array = array.astype(np.float32) @ _LUMA_WEIGHTS
    if array.ndim != 2 or min(array.shape) < MIN_SIDE_PX:
        raise VisionError(
            "image: its shape is {shape}; must be (rows, columns) or (rows, columns, 3), at "
            "least {least_side} px each way",
            shape=str(array.shape),
            least_side=MIN_SIDE_PX,
        )
    plane = np.ascontiguousarray(array, dtype=np.float32)
    low, high = float(plane.min()), float(plane.max())
    if not np.isfinite([low, high]).all():
        raise VisionError("image: a pixel is not a finite number; the camera's data are damaged")
    if low == high:
        raise VisionError(
            "image: every pixel is {low}; the camera is dark, saturated or covered: "
            "check lamp, shutter and exposure",
            low=low,
        )
    return plane


def divide_by_background(image: Image, background: Image) -> Image:
    """Return an image divided by a background image, which does not contain the object.

    The result is free of everything that both images show, such as vignetting, dust and a cell at
    rest.

    Raises
    ------
    VisionError
        If the two differ in size.
    """
    if image.shape != background.shape:
        raise VisionError(
            "background: {columns} × {rows} px against an image of {image_columns} × "
            "{image_rows} px; take it again with this camera setting",
            columns=background.shape[1],
            rows=background.shape[0],
            image_columns=image.shape[1],
            image_rows=image.shape[0],
        )
    min_brightness = 1e-3 * float(np.abs(background).max())
    return np.asarray(image / np.maximum(background, min_brightness), dtype=np.float32)


def estimate_noise_rms(image: Image) -> float:
    """Estimate the rms noise of single pixels from the median of second differences.

    Their kernel ``[1 -2 1; -2 4 -2; 1 -2 1]`` does not respond to planes or to edges along rows or
    columns. White noise of rms σ gives differences of rms 6σ. Other edges are too few to influence
    the median. Source: J. Immerkær, "Fast noise variance estimation", CVIU 64 (1996), here with the
    median to make it robust.
    """
    kernel = np.array([[1, -2, 1], [-2, 4, -2], [1, -2, 1]], dtype=np.float32)
    differences = np.abs(cv2.filter2D(image, cv2.CV_32F, kernel)[1:-1, 1:-1])
    return float(np.median(differences)) / 0.67449 / 6.0
