"""What is to be kept in mind about records that can be diagnosed all the same."""

from collections.abc import Iterable
from dataclasses import dataclass

from rotemina.sim.messages import Message
from rotemina.sim.records.record import Record


@dataclass(frozen=True, slots=True)
class Caution:
    """A sentence about one axis, or about all of a record.

    Attributes
    ----------
    text : Message
        The same whatever the record's file name and place among the others.
    axis : str, optional
    record : int, optional
        Its number among the records, from 0; None for what concerns all of them.
    """

    text: Message
    axis: str | None = None
    record: int | None = None


@dataclass(frozen=True, slots=True)
class Labelled:
    """A record under the name by which messages call it, and its number among the others."""

    record: Record
    name: str
    number: int

    def caution(self, text: Message, axis: str | None = None) -> Caution:
        """Return a caution about this record."""
        return Caution(text, axis, self.number)


def remarks(cautions: Iterable[Caution], axis: str) -> tuple[Message, ...]:
    """Return the sentences that concern an axis, in an order that no order of records changes."""
    return tuple(sorted({one.text for one in cautions if one.axis in (None, axis)}, key=str))
