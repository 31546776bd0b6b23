"""Table of a thrust as text: one point per line, time share and depth share."""

from itertools import pairwise

from rotemina.app.motion.penetration import MAX_TABLE_POINTS
from rotemina.plugins.penetration import tr
from rotemina.plugins.penetration.parameter_quantities import ParameterInputError
from rotemina.sim.messages import POINT, parse_number

ThrustTable = tuple[tuple[float, float], ...]

#: Suggested table: slow at first, fast in the middle.
EXAMPLE_TABLE: ThrustTable = ((0.0, 0.0), (0.3, 0.1), (0.7, 0.9), (1.0, 1.0))


def format_table(table: ThrustTable) -> str:
    """Return a table as text."""
    return "\n".join(f"{time:g}, {depth:g}" for time, depth in table)


def parse_table(text: str) -> ThrustTable:
    """Return the table that a text describes. Empty lines are ignored.

    Raises
    ------
    ParameterInputError
        If a line or the whole table is invalid.
    """
    points = []
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip():
            points.append(_parse_point(number, line.strip()))
    if not 2 <= len(points) <= MAX_TABLE_POINTS:
        raise ParameterInputError(
            tr("table: {n} points; must be 2 to {most}, one per line, from 0, 0 to 1, 1").format(
                n=len(points), most=MAX_TABLE_POINTS
            )
        )
    for number, ((earlier, _), (later, _)) in enumerate(pairwise(points), 2):
        if later <= earlier:
            raise ParameterInputError(
                tr("table, point {number}: time {later:g} must be after {at:g}").format(
                    number=number, later=later, at=earlier
                )
            )
    if points[0] != (0.0, 0.0) or points[-1] != (1.0, 1.0):
        raise ParameterInputError(tr("table: must go from 0, 0 to 1, 1"))
    return tuple(points)


def _parse_point(number: int, line: str) -> tuple[float, float]:
    parts = [part.strip() for part in line.split(",")]
    # The comma separates the two numbers, so the decimal sign is a point in every language.
    shares = [share for part in parts if (share := parse_number(part, POINT)) is not None]
    if len(parts) != 2 or len(shares) != 2:
        raise ParameterInputError(
            tr(
                "table, line {number}: {line!r}; enter a time share, a comma and a depth "
                "share, such as 0.3, 0.1"
            ).format(number=number, line=line[:40])
        )
    time, depth = shares
    for name, value in ((tr("time"), time), (tr("depth"), depth)):
        if not 0.0 <= value <= 1.0:
            raise ParameterInputError(
                tr("table, line {number}: {name} {value:g} must be 0 to 1").format(
                    number=number, name=name, value=value
                )
            )
    return time, depth
