"""The table of a thrust as text: one point per line, time share and depth share."""

from itertools import pairwise

from rotemina.app.motion.penetration.parameters import MOST_POINTS
from rotemina.plugins.penetration import tr
from rotemina.plugins.penetration.parameter_quantities import TypedError
from rotemina.sim.quantities import POINT, parsed

Table = tuple[tuple[float, float], ...]

#: What a table begins with: slow first, fast in the middle.
EXAMPLE: Table = ((0.0, 0.0), (0.3, 0.1), (0.7, 0.9), (1.0, 1.0))


def table_text(table: Table) -> str:
    """Return a table as lines."""
    return "\n".join(f"{at:g}, {depth:g}" for at, depth in table)


def read_table(text: str) -> Table:
    """Return the table of some lines; empty ones do not count.

    Raises
    ------
    TypedError
        With the line that is none.
    """
    points = []
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip():
            points.append(_point(number, line.strip()))
    if not 2 <= len(points) <= MOST_POINTS:
        raise TypedError(
            tr("table: {n} points; must be 2 to {most}, one per line, from 0, 0 to 1, 1").format(
                n=len(points), most=MOST_POINTS
            )
        )
    for number, ((at, _), (later, _)) in enumerate(pairwise(points), 2):
        if later <= at:
            raise TypedError(
                tr("table, point {number}: time {later:g} must be after {at:g}").format(
                    number=number, later=later, at=at
                )
            )
    if points[0] != (0.0, 0.0) or points[-1] != (1.0, 1.0):
        raise TypedError(tr("table: must go from 0, 0 to 1, 1"))
    return tuple(points)


def _point(number: int, line: str) -> tuple[float, float]:
    parts = [part.strip() for part in line.split(",")]
    # The comma is between the two, in every language.
    shares = [share for part in parts if (share := parsed(part, POINT)) is not None]
    if len(parts) != 2 or len(shares) != 2:
        raise TypedError(
            tr(
                "table, line {number}: {line!r}; enter a time share, a comma and a depth "
                "share, such as 0.3, 0.1"
            ).format(number=number, line=line[:40])
        )
    at, depth = shares
    for name, value in ((tr("time"), at), (tr("depth"), depth)):
        if not 0.0 <= value <= 1.0:
            raise TypedError(
                tr("table, line {number}: {name} {value:g} must be 0 to 1").format(
                    number=number, name=name, value=value
                )
            )
    return at, depth
