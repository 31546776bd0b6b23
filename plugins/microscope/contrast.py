"""Contrast: conversion of camera values to screen colours by one lookup table.

This module does not use Qt.
"""

from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from rotemina.drivers.cameras import CameraFrame, Pixels

#: Colours of the screen, 0xffrrggbb.
Colours = NDArray[np.uint32]

AUTO_PERCENTILES = (0.1, 99.9)
GAMMA_RANGE = (0.2, 5.0)
BIN_COUNT = 256
# Levels and histogram use only every fourth row and column, which is accurate enough and faster.
_SAMPLE_STRIDE_PX = 4
# Smallest difference between white and black level, relative to the largest pixel value.
_MIN_LEVEL_SPAN = 1.0 / 255.0
# Rounding the levels allows the lookup table to be reused although pictures are noisy.
_LEVEL_DECIMALS = 3
_SATURATED_COLOUR, _OPAQUE_ALPHA = 0xFFFF2020, 0xFF000000


class ColourTable(StrEnum):
    """Colour scheme of the lookup table."""

    GREY = "grey"
    INVERTED = "grey, inverted"
    PERCEPTUAL = "viridis"
    SATURATED = "grey, saturated red"


@dataclass(frozen=True, slots=True)
class ContrastSettings:
    """Contrast as chosen by the operator.

    The levels ``low`` and ``high`` are relative to the largest pixel value, 0 to 1. They are used
    only if ``auto`` is off.
    """

    auto: bool = True
    low: float = 0.0
    high: float = 1.0
    gamma: float = 1.0
    table: ColourTable = ColourTable.GREY


def compute_levels(frame: CameraFrame, contrast: ContrastSettings) -> tuple[float, float]:
    """Return the levels of black and white: the chosen ones, or percentiles of the picture."""
    if contrast.auto:
        samples = _subsample(frame.pixels)
        low, high = np.percentile(samples, AUTO_PERCENTILES) / frame.saturation_value
    else:
        low, high = contrast.low, contrast.high
    low = round(min(max(float(low), 0.0), 1.0 - _MIN_LEVEL_SPAN), _LEVEL_DECIMALS)
    return low, max(round(float(high), _LEVEL_DECIMALS), low + _MIN_LEVEL_SPAN)


def compute_histogram(frame: CameraFrame) -> NDArray[np.int64]:
    """Return the number of sampled pixels in each of 256 bins, from 0 to the largest value."""
    samples = _subsample(frame.pixels).ravel()
    bins = np.minimum(samples >> (frame.bits - 8), BIN_COUNT - 1) if frame.bits > 8 else samples
    return np.bincount(bins, minlength=BIN_COUNT)


def render_frame(
    frame: CameraFrame,
    contrast: ContrastSettings,
    span: tuple[float, float],
    *,
    columns: tuple[int, int] | None = None,
    rows: tuple[int, int] | None = None,
    size: tuple[int, int] | None = None,
) -> Colours:
    """Return a part of a picture in colours, (height, width) of 0xffrrggbb.

    Parameters
    ----------
    frame : CameraFrame
    contrast : ContrastSettings
    span : (low, high)
        The levels of black and white, from :func:`compute_levels`.
    columns, rows : (first, last + 1), optional
        The part of the picture; by default all of it.
    size : (width, height), optional
        The size to which the part is scaled, px. Enlarged pixels stay squares. If saturated pixels
        are marked, shrinking loses none of them.
    """
    part = frame.pixels[slice(*(rows or (None,))), slice(*(columns or (None,)))]
    size = size or (part.shape[1], part.shape[0])
    scaled = _scale_part(part, size)
    table = _make_table(frame.bits, span, contrast.gamma, contrast.table)
    if frame.is_colour:
        colours = _map_colour_planes(scaled, table)
    else:
        colours = np.take(table, scaled, mode="clip")
    if contrast.table is ColourTable.SATURATED:
        _mark_saturated(part, frame.saturation_value, colours)
    return colours


def to_rgb(colours: Colours) -> NDArray[np.uint8]:
    """Return colours (height, width) as (height, width, 3): red, green, blue."""
    planes = np.ascontiguousarray(colours).view(np.uint8).reshape(*colours.shape, 4)
    return np.ascontiguousarray(planes[..., 2::-1])


def _subsample(pixels: Pixels) -> Pixels:
    samples = pixels[::_SAMPLE_STRIDE_PX, ::_SAMPLE_STRIDE_PX]
    return samples if samples.size else pixels


def _scale_part(part: Pixels, size: tuple[int, int]) -> Pixels:
    if size == (part.shape[1], part.shape[0]):
        return part
    # Enlarged pixels stay squares. Shrinking averages, which keeps fine structures visible.
    ratio = size[0] / part.shape[1]
    interpolation = cv2.INTER_NEAREST
    if ratio < 0.5:
        interpolation = cv2.INTER_AREA
    elif ratio < 1.0:
        interpolation = cv2.INTER_LINEAR
    return np.asarray(cv2.resize(np.ascontiguousarray(part), size, interpolation=interpolation))


@lru_cache(maxsize=8)
def _make_table(bits: int, span: tuple[float, float], gamma: float, table: ColourTable) -> Colours:
    """Return the colour of every pixel value: 256 for 8 bits, or 65536 for 16 bits."""
    count = 1 << (8 if bits <= 8 else 16)
    relative_value = np.arange(count) / ((1 << bits) - 1)
    level = np.clip((relative_value - span[0]) / (span[1] - span[0]), 0.0, 1.0) ** gamma
    grey = np.rint(255.0 * level).astype(np.uint8)
    if table is ColourTable.INVERTED:
        grey = np.asarray(255 - grey, dtype=np.uint8)
    if table is ColourTable.PERCEPTUAL:
        blue, green, red = _make_viridis()[grey].T.astype(np.uint32)
    else:
        red = green = blue = grey.astype(np.uint32)
    colours = np.asarray(_OPAQUE_ALPHA | red << 16 | green << 8 | blue, dtype=np.uint32)
    colours.flags.writeable = False
    return colours


@lru_cache(maxsize=1)
def _make_viridis() -> NDArray[np.uint8]:
    """Return the viridis colour map as blue, green, red (256, 3). It is uniform also in grey."""
    ramp = np.arange(256, dtype=np.uint8)[:, None]
    return np.asarray(cv2.applyColorMap(ramp, cv2.COLORMAP_VIRIDIS)).reshape(256, 3)


def _map_colour_planes(part: Pixels, table: Colours) -> Colours:
    """Apply the levels to red, green and blue separately.

    Only the brightness of the table is used, so that colour pictures keep their colours.
    """
    level = (table & 0xFF).astype(np.uint8)
    colours = np.full((*part.shape[:2], 4), 255, dtype=np.uint8)
    colours[..., 2::-1] = level[part]
    return colours.view(np.uint32)[..., 0]


def _mark_saturated(part: Pixels, saturation_value: int, colours: Colours) -> None:
    saturated = part >= saturation_value
    if saturated.ndim == 3:
        saturated = saturated.any(axis=2)
    if not saturated.any():
        return
    height, width = colours.shape
    if (height, width) == saturated.shape:
        colours[saturated] = _SATURATED_COLOUR
    elif width > saturated.shape[1]:
        enlarged = cv2.resize(
            saturated.astype(np.uint8), (width, height), interpolation=cv2.INTER_NEAREST
        )
        colours[enlarged > 0] = _SATURATED_COLOUR
    else:
        picture_rows, picture_columns = np.nonzero(saturated)
        colours[
            picture_rows * height // saturated.shape[0],
            picture_columns * width // saturated.shape[1],
        ] = _SATURATED_COLOUR
