"""Cautions: limits of the records that do not prevent a diagnosis."""

from collections.abc import Iterable
from dataclasses import dataclass

from rotemina.sim.messages import Message
from rotemina.sim.records import Record


@dataclass(frozen=True, slots=True)
class RecordCaution:
    """A sentence about one axis or about a whole record.

    Attributes
    ----------
    text : Message
        It does not depend on the file name of the record and its position among the records.
    axis : str, optional
        None if the caution concerns all axes.
    record : int, optional
        Number of the record, from 0; None if the caution concerns all records.
    """

    text: Message
    axis: str | None = None
    record: int | None = None


@dataclass(frozen=True, slots=True)
class LabelledRecord:
    """A record with its name in messages and its number among the records, from 0."""

    record: Record
    name: str
    number: int

    def make_caution(self, text: Message, axis: str | None = None) -> RecordCaution:
        """Return a caution about this record."""
        return RecordCaution(text, axis, self.number)


def collect_remarks(cautions: Iterable[RecordCaution], axis: str) -> tuple[Message, ...]:
    """Return the sentences about an axis, in an order that does not depend on the records."""
    return tuple(
        sorted({caution.text for caution in cautions if caution.axis in (None, axis)}, key=str)
    )
