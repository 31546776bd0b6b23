"""A HID report descriptor: the meaning of each bit of each report.

Item tags are those of hid-parser. Its own walk through the items is not used: as of 0.1.0 it
counts an array as one element and a repeated usage not at all, so that all fields behind them sit
at wrong bits; it gives up at Push, Pop and designators; and it does not tell which collection a
field is in.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from hid_parser import (  # type: ignore[import-untyped]  # it has no types
    TagGlobal,
    TagLocal,
    TagMain,
    Type,
)

from rotemina.drivers.inputs.hid.items import DescriptorError, Item, items
from rotemina.sim.messages import message

_APPLICATION = 1
_CONSTANT, _VARIABLE, _RELATIVE, _NULL_STATE = 1 << 0, 1 << 1, 1 << 2, 1 << 6
# More than any device has; a descriptor that says so is damaged, and would take all memory.
_MOST_FIELDS = 4096
_MOST_REPORT_BITS = 8 * 4096
_MOST_CHOICES = 256  # of an array


@dataclass(frozen=True, slots=True)
class Field:
    """One value in a report that the device sends, or the places of one list.

    Attributes
    ----------
    application : int
        Which of :attr:`ReportDescriptor.applications` it belongs to; −1 for none.
    report_id : int
        0 where reports have none.
    offset, size : int
        Its first bit, counted behind the report's number, and how many it has, or each place.
    count : int
        How many places a list has; 1 otherwise.
    low, high : int
        The least and greatest value that it may have; two's complement where ``low`` is negative.
    usages : tuple of int
        Page × 65536 + usage: what it is; of a list, what values from ``low`` on mean.
    flags : int
        As in the main item.
    """

    application: int
    report_id: int
    offset: int
    size: int
    count: int
    low: int
    high: int
    usages: tuple[int, ...]
    flags: int

    @property
    def is_list(self) -> bool:
        """Whether a place has the number of something that is on ("array"), not a state."""
        return not self.flags & _VARIABLE

    @property
    def is_relative(self) -> bool:
        """Whether it reports a change since the previous report."""
        return bool(self.flags & _RELATIVE)

    @property
    def has_null(self) -> bool:
        """Whether a value outside its range means "no value"."""
        return bool(self.flags & _NULL_STATE)


@dataclass(frozen=True, slots=True)
class ReportDescriptor:
    """A device's description of its reports.

    Attributes
    ----------
    applications : tuple of int
        Usages of the top-level application collections.
    fields : tuple of Field
        In the order of the descriptor, padding left out.
    bits : mapping of int to int
        How many bits a report has, by its number.
    """

    applications: tuple[int, ...]
    fields: tuple[Field, ...]
    bits: Mapping[int, int]

    @property
    def numbered(self) -> bool:
        """Whether a report begins with a byte that is its number."""
        return any(self.bits)

    @classmethod
    def parse(cls, descriptor: bytes) -> "ReportDescriptor":
        """Read a descriptor.

        Raises
        ------
        DescriptorError
            If it is cut off or makes no sense, with the byte where.
        """
        walk = _Walk()
        for item in items(descriptor):
            walk.take(item)
        return cls(tuple(walk.applications), tuple(walk.fields), MappingProxyType(walk.bits))


@dataclass(frozen=True, slots=True)
class _Globals:
    """What holds from one main item to the next, and is pushed and popped."""

    page: int = 0
    low: int = 0
    high: Item | None = None
    size: int = 0
    count: int = 0
    report_id: int = 0

    def range(self) -> tuple[int, int]:
        """Return the least and greatest value.

        Many a device writes 255 in one byte, which is −1, where nothing negative can be meant.
        """
        if self.high is None:
            return self.low, 0
        high = self.high.signed
        return self.low, self.high.unsigned if self.low >= 0 and high < self.low else high


@dataclass(slots=True)
class _Locals:
    """What holds for the next main item only."""

    usages: list[range] = field(default_factory=list)
    least: int | None = None

    def named(self, page: int) -> Iterator[int]:
        """Yield the usages; one that came before any page is of the page that holds now."""
        for span in self.usages:
            for usage in span:
                yield usage if usage >> 16 else page << 16 | usage


class _Walk:
    """Goes through the items of a descriptor and notes the fields of input reports."""

    def __init__(self) -> None:
        self.applications: list[int] = []
        self.fields: list[Field] = []
        self.bits: dict[int, int] = {}
        self._globals = _Globals()
        self._pushed: list[_Globals] = []
        self._locals = _Locals()
        self._collections: list[int] = []  # the application that each open one belongs to

    def take(self, item: Item) -> None:
        """Advance by an item; of a kind that is of no use here it changes nothing."""
        if item.type == Type.MAIN:
            self._main(item)
            self._locals = _Locals()
        elif item.type == Type.GLOBAL:
            self._global(item)
        elif item.type == Type.LOCAL:
            self._local(item)

    def _main(self, item: Item) -> None:
        if item.tag == TagMain.COLLECTION:
            application = self._collections[-1] if self._collections else -1
            if not self._collections and item.unsigned == _APPLICATION:
                application = len(self.applications)
                self.applications.append(next(self._locals.named(self._globals.page), 0))
            self._collections.append(application)
        elif item.tag == TagMain.END_COLLECTION:
            if not self._collections:
                raise _nonsense(item, "a collection ends that has not begun")
            self._collections.pop()
        elif item.tag == TagMain.INPUT:
            self._input(item)

    def _input(self, item: Item) -> None:
        now = self._globals
        offset = self.bits.get(now.report_id, 0)
        fields = len(self.fields) + now.count
        if fields > _MOST_FIELDS or offset + now.count * now.size > _MOST_REPORT_BITS:
            raise _nonsense(item, f"{now.count} more fields of {now.size} bits are too many")
        self.bits[now.report_id] = offset + now.count * now.size
        usages = self._first_usages(item)
        if item.unsigned & _CONSTANT or not usages or not now.size:
            return  # padding
        low, high = now.range()
        whole = Field(
            self._collections[-1] if self._collections else -1,
            now.report_id,
            offset,
            now.size,
            now.count,
            low,
            high,
            usages,
            item.unsigned,
        )
        if whole.is_list:
            self.fields.append(whole)
            return
        for index in range(now.count):
            # The last usage is that of all elements that are left.
            own = usages[min(index, len(usages) - 1)]
            at = offset + index * now.size
            self.fields.append(replace(whole, offset=at, count=1, usages=(own,)))

    def _first_usages(self, item: Item) -> tuple[int, ...]:
        """Return the usages that an input item can make use of."""
        now = self._globals
        low, high = now.range()
        wanted = now.count if item.unsigned & _VARIABLE else min(high - low + 1, _MOST_CHOICES)
        return tuple(
            usage for usage, _ in zip(self._locals.named(now.page), range(wanted), strict=False)
        )

    def _global(self, item: Item) -> None:
        now = self._globals
        if item.tag in (TagGlobal.PUSH, TagGlobal.POP):
            self._push_or_pop(item)
        elif item.tag == TagGlobal.USAGE_PAGE:
            self._globals = replace(now, page=item.unsigned & 0xFFFF)
        elif item.tag == TagGlobal.LOGICAL_MINIMUM:
            self._globals = replace(now, low=item.signed)
        elif item.tag == TagGlobal.LOGICAL_MAXIMUM:
            self._globals = replace(now, high=item)
        elif item.tag == TagGlobal.REPORT_SIZE:
            self._globals = replace(now, size=item.unsigned)
        elif item.tag == TagGlobal.REPORT_COUNT:
            self._globals = replace(now, count=item.unsigned)
        elif item.tag == TagGlobal.REPORT_ID:
            if not 1 <= item.unsigned <= 0xFF:
                raise _nonsense(item, f"a report of number {item.unsigned}: must be 1 to 255")
            self._globals = replace(now, report_id=item.unsigned)

    def _push_or_pop(self, item: Item) -> None:
        if item.tag == TagGlobal.PUSH:
            self._pushed.append(self._globals)
        elif self._pushed:
            self._globals = self._pushed.pop()
        else:
            raise _nonsense(item, "Pop without a Push")

    def _local(self, item: Item) -> None:
        # With four bytes of data the page is in the usage itself.
        usage = item.unsigned
        if len(item.data) < 4:
            usage |= self._globals.page << 16
        if item.tag == TagLocal.USAGE:
            self._locals.usages.append(range(usage, usage + 1))
        elif item.tag == TagLocal.USAGE_MINIMUM:
            self._locals.least = usage
        elif item.tag == TagLocal.USAGE_MAXIMUM and self._locals.least is not None:
            self._locals.usages.append(range(self._locals.least, usage + 1))


def _nonsense(item: Item, what: str) -> DescriptorError:
    return DescriptorError(
        message("engine", "its report descriptor is invalid at byte {at}: {what}").fill(
            at=item.at, what=what
        )
    )
