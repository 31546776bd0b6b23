"""Images as the computations take them: one plane of single precision."""

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from rotemina.sim.messages import message
from rotemina.sim.vision.errors import VisionError

Image = NDArray[np.float32]

LEAST_SIDE = 16  # px
_LUMA = np.array([0.299, 0.587, 0.114], dtype=np.float32)  # ITU-R BT.601, of red, green, blue


def grey(image: NDArray[Any]) -> Image:
    """Return an image (rows, columns) or (rows, columns, 3: red, green, blue) as one plane.

    Raises
    ------
    VisionError
        If it is no image, too small, not finite, or one brightness throughout (black or saturated).
    """
    array = np.asarray(image)
    if array.ndim == 3 and array.shape[2] == 3:
        array = array.astype(np.float32) @ _LUMA
    if array.ndim != 2 or min(array.shape) < LEAST_SIDE:
        raise VisionError(
            message(
                "engine",
                "image: its shape is {shape}; must be (rows, columns) or (rows, columns, 3), at "
                "least {least_side} px each way",
            ).fill(shape=str(array.shape), least_side=LEAST_SIDE)
        )
    plane = np.ascontiguousarray(array, dtype=np.float32)
    low, high = float(plane.min()), float(plane.max())
    if not np.isfinite([low, high]).all():
        raise VisionError(
            message(
                "engine", "image: a pixel is not a finite number; the camera's data are damaged"
            )
        )
    if low == high:
        raise VisionError(
            message(
                "engine",
                "image: every pixel is {low}; the camera is dark, saturated or covered: "
                "check lamp, shutter and exposure",
            ).fill(low=low)
        )
    return plane


def relative_to(image: Image, background: Image) -> Image:
    """Return an image as a share of one that was taken without what is looked for.

    Whatever stays, such as vignetting, dust and a cell at rest, goes out.

    Raises
    ------
    VisionError
        If the two differ in size.
    """
    if image.shape != background.shape:
        raise VisionError(
            message(
                "engine",
                "background: {columns} × {rows} px against an image of {image_columns} × "
                "{image_rows} px; "
                "take it again with this camera setting",
            ).fill(
                columns=background.shape[1],
                rows=background.shape[0],
                image_columns=image.shape[1],
                image_rows=image.shape[0],
            )
        )
    least = 1e-3 * float(np.abs(background).max())
    return np.asarray(image / np.maximum(background, least), dtype=np.float32)


def noise_rms(image: Image) -> float:
    """Return the noise of single pixels, as the median of second differences sees it.

    Their kernel ``[1 -2 1; -2 4 -2; 1 -2 1]`` is blind to planes and edges along rows or columns;
    white noise of rms σ comes out as 6σ, and edges are too few to move the median.
    Source: J. Immerkær, "Fast noise variance estimation", CVIU 64 (1996), made robust.
    """
    kernel = np.array([[1, -2, 1], [-2, 4, -2], [1, -2, 1]], dtype=np.float32)
    differences = np.abs(cv2.filter2D(image, cv2.CV_32F, kernel)[1:-1, 1:-1])
    return float(np.median(differences)) / 0.67449 / 6.0
