"""Contrast: conversion of camera values to screen colours by one table. Free of Qt."""

from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from rotemina.drivers.cameras.frame import Frame, Pixels

Colours = NDArray[np.uint32]  # 0xffrrggbb

AUTO_PERCENT = (0.1, 99.9)
GAMMA = (0.2, 5.0)
BINS = 256
_STRIDE = 4  # rows and columns between the pixels that levels and histogram are made of
_LEAST_SPAN = 1.0 / 255.0  # of the levels, share of the largest number
_DECIMALS = 3  # of levels: noise is not to make another table for every picture
_RED, _OPAQUE = 0xFFFF2020, 0xFF000000


class Table(StrEnum):
    """How a level is coloured."""

    GREY = "grey"
    INVERTED = "grey, inverted"
    PERCEPTUAL = "viridis"
    SATURATED = "grey, saturated red"


@dataclass(frozen=True, slots=True)
class Contrast:
    """What the operator chose; levels are shares of the largest number, 0 to 1."""

    auto: bool = True
    low: float = 0.0
    high: float = 1.0
    gamma: float = 1.0
    table: Table = Table.GREY


def levels(frame: Frame, contrast: Contrast) -> tuple[float, float]:
    """Return the levels that become black and white: those chosen, or percentiles."""
    if contrast.auto:
        some = _sampled(frame.pixels)
        low, high = np.percentile(some, AUTO_PERCENT) / frame.largest
    else:
        low, high = contrast.low, contrast.high
    low = round(min(max(float(low), 0.0), 1.0 - _LEAST_SPAN), _DECIMALS)
    return low, max(round(float(high), _DECIMALS), low + _LEAST_SPAN)


def histogram(frame: Frame) -> NDArray[np.int64]:
    """Return how many of the sampled pixels are in each of 256 bins from 0 to the largest."""
    some = _sampled(frame.pixels).ravel()
    bins = np.minimum(some >> (frame.bits - 8), BINS - 1) if frame.bits > 8 else some
    return np.bincount(bins, minlength=BINS)


def shown(
    frame: Frame,
    contrast: Contrast,
    span: tuple[float, float],
    *,
    columns: tuple[int, int] | None = None,
    rows: tuple[int, int] | None = None,
    size: tuple[int, int] | None = None,
) -> Colours:
    """Return a part of a picture in colours, (height, width) of 0xffrrggbb.

    Parameters
    ----------
    frame : Frame
    contrast : Contrast
    span : (low, high)
        Of :func:`levels`.
    columns, rows : (first, behind the last), optional
        All by default.
    size : (width, height), optional
        To which the part is scaled, px. Enlarged, pixels stay squares; where saturated ones are
        marked, none gets lost by shrinking.
    """
    part = frame.pixels[slice(*(rows or (None,))), slice(*(columns or (None,)))]
    size = size or (part.shape[1], part.shape[0])
    scaled = _scaled(part, size)
    table = _table(frame.bits, span, contrast.gamma, contrast.table)
    if frame.colour:
        colours = _coloured(scaled, table)
    else:
        colours = np.take(table, scaled, mode="clip")
    if contrast.table is Table.SATURATED:
        _mark_saturated(part, frame.largest, colours)
    return colours


def as_rgb(colours: Colours) -> NDArray[np.uint8]:
    """Return colours (h, w) as (h, w, 3): red, green, blue."""
    planes = np.ascontiguousarray(colours).view(np.uint8).reshape(*colours.shape, 4)
    return np.ascontiguousarray(planes[..., 2::-1])


def _sampled(pixels: Pixels) -> Pixels:
    some = pixels[::_STRIDE, ::_STRIDE]
    return some if some.size else pixels


def _scaled(part: Pixels, size: tuple[int, int]) -> Pixels:
    if size == (part.shape[1], part.shape[0]):
        return part
    ratio = size[0] / part.shape[1]
    way = cv2.INTER_NEAREST
    if ratio < 0.5:
        way = cv2.INTER_AREA
    elif ratio < 1.0:
        way = cv2.INTER_LINEAR
    return np.asarray(cv2.resize(np.ascontiguousarray(part), size, interpolation=way))


@lru_cache(maxsize=8)
def _table(bits: int, span: tuple[float, float], gamma: float, table: Table) -> Colours:
    """Return the colour of every number: 256 of 8 bits, or all 65536 of 16."""
    count = 1 << (8 if bits <= 8 else 16)
    share = np.arange(count) / ((1 << bits) - 1)
    level = np.clip((share - span[0]) / (span[1] - span[0]), 0.0, 1.0) ** gamma
    grey = np.rint(255.0 * level).astype(np.uint8)
    if table is Table.INVERTED:
        grey = np.asarray(255 - grey, dtype=np.uint8)
    if table is Table.PERCEPTUAL:
        blue, green, red = _viridis()[grey].T.astype(np.uint32)
    else:
        red = green = blue = grey.astype(np.uint32)
    colours = np.asarray(_OPAQUE | red << 16 | green << 8 | blue, dtype=np.uint32)
    colours.flags.writeable = False
    return colours


@lru_cache(maxsize=1)
def _viridis() -> NDArray[np.uint8]:
    """Return blue, green, red (256, 3) of a map whose steps look even, and grey too."""
    ramp = np.arange(256, dtype=np.uint8)[:, None]
    return np.asarray(cv2.applyColorMap(ramp, cv2.COLORMAP_VIRIDIS)).reshape(256, 3)


def _coloured(part: Pixels, table: Colours) -> Colours:
    """Give red, green and blue their levels each; a colour keeps being one in every table."""
    level = (table & 0xFF).astype(np.uint8)
    out = np.full((*part.shape[:2], 4), 255, dtype=np.uint8)
    out[..., 2::-1] = level[part]
    return out.view(np.uint32)[..., 0]


def _mark_saturated(part: Pixels, largest: int, colours: Colours) -> None:
    full = part >= largest
    if full.ndim == 3:
        full = full.any(axis=2)
    if not full.any():
        return
    height, width = colours.shape
    if (height, width) == full.shape:
        colours[full] = _RED
    elif width > full.shape[1]:
        grown = cv2.resize(full.astype(np.uint8), (width, height), interpolation=cv2.INTER_NEAREST)
        colours[grown > 0] = _RED
    else:
        row, column = np.nonzero(full)
        colours[row * height // full.shape[0], column * width // full.shape[1]] = _RED
