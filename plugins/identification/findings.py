"""Findings of one analysis: pictures, figures, numbers to save, notices."""

import logging
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from rotemina.plugins.identification import mark
from rotemina.plugins.identification.filled_template import FilledTemplate
from rotemina.plugins.identification.record_query import Question
from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import InputError
from rotemina.sim.quantities import Scale, scale_of

logger = logging.getLogger(__name__)

NONE = "–"


class Curve(NamedTuple):
    """A line of a picture: its name, the theme's colour role, width in pixels, and points (n,)."""

    name: str
    role: str
    x: FloatArray
    y: FloatArray
    width: int = 1


class Picture(NamedTuple):
    """Curves over the same axes. Titles name quantities with their units.

    ``in_time`` says that x only grows, so that the drawing may be thinned without loss; ``span``
    is what the vertical axis shows, else it follows the curves.
    """

    title: str
    bottom: str
    curves: tuple[Curve, ...]
    log_x: bool = False
    log_y: bool = False
    in_time: bool = True
    span: tuple[float, float] | None = None


class Column(NamedTuple):
    """A column of the file that can be saved: heading with unit, one number a row or None."""

    heading: str
    values: tuple[float | None, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Findings:
    """The answer to a question; its texts are English, as files have them, and known by tables.

    Attributes
    ----------
    question : what was asked, so that a late answer can be told.
    pictures : up to three.
    head, rows : the sheet of figures, as text with units.
    columns : the numbers behind it, for a file.
    notices : what the record cannot tell, in words.
    """

    question: Question
    pictures: tuple[Picture, ...] = ()
    head: tuple[str, ...] = ()
    rows: tuple[tuple[str, ...], ...] = ()
    columns: tuple[Column, ...] = ()
    notices: tuple[str, ...] = ()


def ratio_scale(question: Question, largest: float) -> Scale:
    """Return the unit of output over input, none where both are of one kind."""
    over, under = question.unit(question.answer), question.unit(question.drive)
    if over == under:
        return Scale("", 1.0)
    if under == "V":
        top = scale_of(over, largest)
        return Scale(f"{top.symbol}/V", top.per_si)
    bottom = scale_of(under, 1e-6)  # volts a µm or a µrad
    return Scale(f"V/{bottom.symbol}", 1.0 / bottom.per_si)


def answered(look: Callable[[Question], Findings], question: Question) -> Findings:
    """Look at a record; what it refuses to tell becomes a notice."""
    try:
        return look(question)
    except InputError as error:
        return Findings(question, notices=(str(error),))
    except Exception as error:  # a fault of the program must reach the operator, not vanish
        logger.exception("identification failed")
        reason = FilledTemplate(
            mark("program error: {kind}: {error}"), kind=type(error).__name__, error=error
        )
        return Findings(question, notices=(reason,))
