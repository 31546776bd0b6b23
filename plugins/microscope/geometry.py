"""Mapping between picture pixels and the screen. This module does not use Qt.

An integer coordinate is the centre of a pixel: pixel 0 reaches from −0.5 to 0.5.
"""

from dataclasses import dataclass, replace
from math import ceil, floor

MAX_ZOOM = 40.0


@dataclass(frozen=True, slots=True)
class VisiblePart:
    """Visible part of the picture, and its position on the screen.

    ``columns`` and ``rows`` are (first, last + 1) in picture pixels. ``left``, ``top``, ``width``
    and ``height`` are in screen px.
    """

    columns: tuple[int, int]
    rows: tuple[int, int]
    left: float
    top: float
    width: int
    height: int


@dataclass(frozen=True, slots=True)
class Viewport:
    """View of a picture in a widget.

    The picture has ``columns`` × ``rows`` px, the widget ``width`` × ``height`` screen px.
    ``zoom`` is the number of screen px per pixel. ``at`` is the pixel at the centre of the widget.
    If ``fitted``, the whole picture stays visible when the widget or the picture changes its size.
    """

    width: float = 1.0
    height: float = 1.0
    columns: int = 1
    rows: int = 1
    zoom: float = 1.0
    at: tuple[float, float] = (0.0, 0.0)
    fitted: bool = True

    @property
    def fit_zoom(self) -> float:
        """The zoom at which the whole picture is visible."""
        return max(min(self.width / self.columns, self.height / self.rows), 1e-3)

    @property
    def picture_centre(self) -> tuple[float, float]:
        """The centre of the picture, px."""
        return 0.5 * (self.columns - 1), 0.5 * (self.rows - 1)

    def zoom_to_fit(self) -> "Viewport":
        """Return a view of the whole picture."""
        return replace(self, zoom=self.fit_zoom, at=self.picture_centre, fitted=True)

    def zoom_one_to_one(self) -> "Viewport":
        """Return a view with one screen pixel per pixel and the same centre."""
        return self.zoom_about(1.0 / self.zoom, (0.5 * self.width, 0.5 * self.height))

    def with_widget_size(self, width: float, height: float) -> "Viewport":
        """Return the view for a widget of another size."""
        resized = replace(self, width=max(width, 1.0), height=max(height, 1.0))
        return resized.zoom_to_fit() if self.fitted else resized._clamp_centre()

    def with_picture_size(self, columns: int, rows: int) -> "Viewport":
        """Return the view for a picture of another size. The whole picture is then visible."""
        if (columns, rows) == (self.columns, self.rows):
            return self
        return replace(self, columns=columns, rows=rows).zoom_to_fit()

    def zoom_about(self, factor: float, anchor: tuple[float, float]) -> "Viewport":
        """Return a view zoomed by a factor, within limits.

        The pixel at ``anchor``, a point in screen px, stays in place.
        """
        min_zoom = min(self.fit_zoom, 1.0)
        zoom = min(max(self.zoom * factor, min_zoom), MAX_ZOOM)
        anchor_pixel = self.to_picture(*anchor)
        at = (
            anchor_pixel[0] - (anchor[0] - 0.5 * self.width) / zoom,
            anchor_pixel[1] - (anchor[1] - 0.5 * self.height) / zoom,
        )
        return replace(self, zoom=zoom, at=at, fitted=False)._clamp_centre()

    def pan_by(self, right: float, down: float) -> "Viewport":
        """Return a view with the picture moved by a number of screen px."""
        at = self.at[0] - right / self.zoom, self.at[1] - down / self.zoom
        return replace(self, at=at, fitted=False)._clamp_centre()

    def to_screen(self, column: float, row: float) -> tuple[float, float]:
        """Return the screen position of the centre of a pixel, screen px."""
        return (
            0.5 * self.width + (column - self.at[0]) * self.zoom,
            0.5 * self.height + (row - self.at[1]) * self.zoom,
        )

    def to_picture(self, x: float, y: float) -> tuple[float, float]:
        """Return the column and row at a screen position."""
        return (
            self.at[0] + (x - 0.5 * self.width) / self.zoom,
            self.at[1] + (y - 0.5 * self.height) / self.zoom,
        )

    def contains(self, column: float, row: float) -> bool:
        """Return whether a position lies within the picture."""
        return -0.5 <= column < self.columns - 0.5 and -0.5 <= row < self.rows - 0.5

    def find_visible_part(self) -> VisiblePart:
        """Return the part of the picture, in whole pixels, that covers the widget.

        Its size on the screen is rounded to whole screen px. Overlays are therefore off by at most
        one screen pixel.
        """
        left, top = self.to_picture(0.0, 0.0)
        right, bottom = self.to_picture(self.width, self.height)
        first_column, end_column = _cover_with_pixels(left, right, self.columns)
        first_row, end_row = _cover_with_pixels(top, bottom, self.rows)
        x, y = self.to_screen(first_column - 0.5, first_row - 0.5)
        return VisiblePart(
            (first_column, end_column),
            (first_row, end_row),
            x,
            y,
            max(round((end_column - first_column) * self.zoom), 1),
            max(round((end_row - first_row) * self.zoom), 1),
        )

    def _clamp_centre(self) -> "Viewport":
        column = min(max(self.at[0], -0.5), self.columns - 0.5)
        row = min(max(self.at[1], -0.5), self.rows - 0.5)
        return replace(self, at=(column, row))


def _cover_with_pixels(begin: float, end: float, count: int) -> tuple[int, int]:
    """Return the pixels from ``begin`` to ``end`` as (first, last + 1), at least one pixel."""
    first = min(max(floor(begin + 0.5), 0), count - 1)
    return first, min(max(ceil(end + 0.5), first + 1), count)
