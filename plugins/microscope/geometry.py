"""Mapping of picture pixels to the screen. Free of Qt.

A pixel's number is that of its middle: pixel 0 reaches from −0.5 to 0.5.
"""

from dataclasses import dataclass, replace
from math import ceil, floor

GREATEST_ZOOM = 40.0


@dataclass(frozen=True, slots=True)
class Part:
    """What is in sight: columns and rows of the picture, and where they go, screen px."""

    columns: tuple[int, int]
    rows: tuple[int, int]
    left: float
    top: float
    width: int
    height: int


@dataclass(frozen=True, slots=True)
class Viewport:
    """A picture of ``columns`` × ``rows`` px in a widget of ``width`` × ``height`` screen px.

    ``zoom`` is screen px per pixel, and ``at`` the pixel in the middle of the widget. A picture
    that is ``fitted`` stays so when either size changes.
    """

    width: float = 1.0
    height: float = 1.0
    columns: int = 1
    rows: int = 1
    zoom: float = 1.0
    at: tuple[float, float] = (0.0, 0.0)
    fitted: bool = True

    @property
    def fitting(self) -> float:
        """The zoom at which all of the picture is seen."""
        return max(min(self.width / self.columns, self.height / self.rows), 1e-3)

    @property
    def middle(self) -> tuple[float, float]:
        """The middle of the picture."""
        return 0.5 * (self.columns - 1), 0.5 * (self.rows - 1)

    def fit(self) -> "Viewport":
        """Show all of it."""
        return replace(self, zoom=self.fitting, at=self.middle, fitted=True)

    def one_to_one(self) -> "Viewport":
        """Show each pixel as one of the screen's, about the same middle."""
        return self.zoomed(1.0 / self.zoom, (0.5 * self.width, 0.5 * self.height))

    def resized(self, width: float, height: float) -> "Viewport":
        """Return it in a widget of another size."""
        changed = replace(self, width=max(width, 1.0), height=max(height, 1.0))
        return changed.fit() if self.fitted else changed._within()

    def showing(self, columns: int, rows: int) -> "Viewport":
        """Return it with a picture of another size, which is fitted."""
        if (columns, rows) == (self.columns, self.rows):
            return self
        return replace(self, columns=columns, rows=rows).fit()

    def zoomed(self, factor: float, about: tuple[float, float]) -> "Viewport":
        """Zoom, within limits; what is at ``about``, screen px, stays there."""
        least = min(self.fitting, 1.0)
        zoom = min(max(self.zoom * factor, least), GREATEST_ZOOM)
        held = self.to_picture(*about)
        at = (
            held[0] - (about[0] - 0.5 * self.width) / zoom,
            held[1] - (about[1] - 0.5 * self.height) / zoom,
        )
        return replace(self, zoom=zoom, at=at, fitted=False)._within()

    def panned(self, right: float, down: float) -> "Viewport":
        """Move the picture by so many screen px."""
        at = self.at[0] - right / self.zoom, self.at[1] - down / self.zoom
        return replace(self, at=at, fitted=False)._within()

    def to_screen(self, column: float, row: float) -> tuple[float, float]:
        """Return where a pixel's middle is, screen px."""
        return (
            0.5 * self.width + (column - self.at[0]) * self.zoom,
            0.5 * self.height + (row - self.at[1]) * self.zoom,
        )

    def to_picture(self, x: float, y: float) -> tuple[float, float]:
        """Return which column and row is at a place of the screen."""
        return (
            self.at[0] + (x - 0.5 * self.width) / self.zoom,
            self.at[1] + (y - 0.5 * self.height) / self.zoom,
        )

    def holds(self, column: float, row: float) -> bool:
        """Return whether that is a pixel of the picture."""
        return -0.5 <= column < self.columns - 0.5 and -0.5 <= row < self.rows - 0.5

    def part(self) -> Part:
        """Return whole pixels that cover what is in sight.

        They go to a whole number of screen px: what is drawn over the picture is within one screen
        px of what it marks.
        """
        left, top = self.to_picture(0.0, 0.0)
        right, bottom = self.to_picture(self.width, self.height)
        first, last = _whole(left, right, self.columns)
        upper, lower = _whole(top, bottom, self.rows)
        x, y = self.to_screen(first - 0.5, upper - 0.5)
        return Part(
            (first, last),
            (upper, lower),
            x,
            y,
            max(round((last - first) * self.zoom), 1),
            max(round((lower - upper) * self.zoom), 1),
        )

    def _within(self) -> "Viewport":
        """Keep the middle of the widget in the picture."""
        column = min(max(self.at[0], -0.5), self.columns - 0.5)
        row = min(max(self.at[1], -0.5), self.rows - 0.5)
        return replace(self, at=(column, row))


def _whole(begin: float, end: float, count: int) -> tuple[int, int]:
    """Return the pixels from the one at ``begin`` to that at ``end``, at least one."""
    first = min(max(floor(begin + 0.5), 0), count - 1)
    return first, min(max(ceil(end + 0.5), first + 1), count)
