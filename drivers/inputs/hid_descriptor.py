"""A HID report descriptor: the meaning of each bit in each report.

The item tags come from hid-parser. The parser of its version 0.1.0 is not used, for these reasons:
It counts an array as one element and ignores repeated usages, so that all later fields get wrong
bit positions. It fails at Push, Pop and designators. It does not report the collection of a field.
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

from rotemina.drivers.contract import DescriptorError
from rotemina.drivers.inputs.hid_items import DescriptorItem, parse_items

_APPLICATION_COLLECTION = 1
_CONSTANT_FLAG, _VARIABLE_FLAG, _RELATIVE_FLAG, _NULL_STATE_FLAG = 1 << 0, 1 << 1, 1 << 2, 1 << 6
# No device exceeds these limits. A damaged descriptor with huge counts would exhaust the memory.
_MAX_FIELDS = 4096
_MAX_REPORT_BITS = 8 * 4096
_MAX_ARRAY_USAGES = 256


@dataclass(frozen=True, slots=True)
class ReportField:
    """One value in an input report, or one list of values (an "array" in HID).

    Attributes
    ----------
    application : int
        Index in :attr:`ReportDescriptor.applications`; −1 for none.
    report_id : int
        Number of the report; 0 if reports have no numbers.
    offset, size : int
        First bit, counted from the end of the report's number; and number of bits of the value, or
        of each place in a list.
    count : int
        Number of places in a list; 1 for a single value.
    low, high : int
        Smallest and largest value. Values are in two's complement if ``low`` is negative.
    usages : tuple of int
        Page × 65536 + usage. For a list, the usage of each value from ``low`` on.
    flags : int
        Flags of the main item.
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
        """Whether it is a list, in which each place contains the number of a control that is on."""
        return not self.flags & _VARIABLE_FLAG

    @property
    def is_relative(self) -> bool:
        """Whether the value is the change since the previous report."""
        return bool(self.flags & _RELATIVE_FLAG)

    @property
    def has_null(self) -> bool:
        """Whether a value outside the range means "no value"."""
        return bool(self.flags & _NULL_STATE_FLAG)


@dataclass(frozen=True, slots=True)
class ReportDescriptor:
    """A device's description of its reports.

    Attributes
    ----------
    applications : tuple of int
        Usages of the top-level application collections.
    fields : tuple of ReportField
        Fields in the order of the descriptor, without padding.
    bits : mapping of int to int
        Number of bits of each report, by report number.
    """

    applications: tuple[int, ...]
    fields: tuple[ReportField, ...]
    bits: Mapping[int, int]

    @property
    def has_report_ids(self) -> bool:
        """Whether each report begins with a byte that contains the report number."""
        return any(self.bits)

    @classmethod
    def parse(cls, descriptor: bytes) -> "ReportDescriptor":
        """Read a descriptor.

        Raises
        ------
        DescriptorError
            If it is truncated or invalid. The message contains the position of the byte.
        """
        builder = _DescriptorBuilder()
        for item in parse_items(descriptor):
            builder.apply_item(item)
        return cls(
            tuple(builder.applications), tuple(builder.fields), MappingProxyType(builder.bits)
        )


@dataclass(frozen=True, slots=True)
class _GlobalItems:
    page: int = 0
    low: int = 0
    high: DescriptorItem | None = None
    size: int = 0
    count: int = 0
    report_id: int = 0

    def find_range(self) -> tuple[int, int]:
        """Return the smallest and the largest value.

        Many devices write a maximum of 255 in one byte, which means −1. If the minimum is not
        negative and exceeds the maximum, the maximum is therefore taken as unsigned.
        """
        if self.high is None:
            return self.low, 0
        signed_high = self.high.signed
        is_unsigned = self.low >= 0 and signed_high < self.low
        return self.low, self.high.unsigned if is_unsigned else signed_high


@dataclass(slots=True)
class _LocalItems:
    usage_ranges: list[range] = field(default_factory=list)
    usage_minimum: int | None = None

    def iterate_usages(self, page: int) -> Iterator[int]:
        """Yield the usages; a usage without a page belongs to the current page."""
        for usage_range in self.usage_ranges:
            for usage in usage_range:
                yield usage if usage >> 16 else page << 16 | usage


class _DescriptorBuilder:
    def __init__(self) -> None:
        self.applications: list[int] = []
        self.fields: list[ReportField] = []
        self.bits: dict[int, int] = {}
        self._globals = _GlobalItems()
        self._global_stack: list[_GlobalItems] = []
        self._locals = _LocalItems()
        # Application index of each open collection, innermost last.
        self._open_collections: list[int] = []

    def apply_item(self, item: DescriptorItem) -> None:
        """Apply an item; items that do not affect input reports are ignored."""
        if item.type == Type.MAIN:
            self._apply_main(item)
            self._locals = _LocalItems()
        elif item.type == Type.GLOBAL:
            self._apply_global(item)
        elif item.type == Type.LOCAL:
            self._apply_local(item)

    def _apply_main(self, item: DescriptorItem) -> None:
        if item.tag == TagMain.COLLECTION:
            application = self._open_collections[-1] if self._open_collections else -1
            if not self._open_collections and item.unsigned == _APPLICATION_COLLECTION:
                application = len(self.applications)
                self.applications.append(next(self._locals.iterate_usages(self._globals.page), 0))
            self._open_collections.append(application)
        elif item.tag == TagMain.END_COLLECTION:
            if not self._open_collections:
                raise _make_error(item, "a collection ends that has not begun")
            self._open_collections.pop()
        elif item.tag == TagMain.INPUT:
            self._add_input(item)

    def _add_input(self, item: DescriptorItem) -> None:
        state = self._globals
        offset = self.bits.get(state.report_id, 0)
        field_count = len(self.fields) + state.count
        if field_count > _MAX_FIELDS or offset + state.count * state.size > _MAX_REPORT_BITS:
            raise _make_error(item, f"{state.count} more fields of {state.size} bits are too many")
        self.bits[state.report_id] = offset + state.count * state.size
        usages = self._select_usages(item)
        # A field is padding if it is constant, or has no usage or no size.
        if item.unsigned & _CONSTANT_FLAG or not usages or not state.size:
            return
        low, high = state.find_range()
        template = ReportField(
            self._open_collections[-1] if self._open_collections else -1,
            state.report_id,
            offset,
            state.size,
            state.count,
            low,
            high,
            usages,
            item.unsigned,
        )
        if template.is_list:
            self.fields.append(template)
            return
        for index in range(state.count):
            # The last usage applies to all remaining elements.
            usage = usages[min(index, len(usages) - 1)]
            position = offset + index * state.size
            self.fields.append(replace(template, offset=position, count=1, usages=(usage,)))

    def _select_usages(self, item: DescriptorItem) -> tuple[int, ...]:
        """Return the usages of an input item, one for each element, or for each value of a list."""
        state = self._globals
        low, high = state.find_range()
        count = (
            state.count
            if item.unsigned & _VARIABLE_FLAG
            else min(high - low + 1, _MAX_ARRAY_USAGES)
        )
        return tuple(
            usage
            for usage, _ in zip(self._locals.iterate_usages(state.page), range(count), strict=False)
        )

    def _apply_global(self, item: DescriptorItem) -> None:
        state = self._globals
        if item.tag in (TagGlobal.PUSH, TagGlobal.POP):
            self._push_or_pop(item)
        elif item.tag == TagGlobal.USAGE_PAGE:
            self._globals = replace(state, page=item.unsigned & 0xFFFF)
        elif item.tag == TagGlobal.LOGICAL_MINIMUM:
            self._globals = replace(state, low=item.signed)
        elif item.tag == TagGlobal.LOGICAL_MAXIMUM:
            self._globals = replace(state, high=item)
        elif item.tag == TagGlobal.REPORT_SIZE:
            self._globals = replace(state, size=item.unsigned)
        elif item.tag == TagGlobal.REPORT_COUNT:
            self._globals = replace(state, count=item.unsigned)
        elif item.tag == TagGlobal.REPORT_ID:
            if not 1 <= item.unsigned <= 0xFF:
                raise _make_error(item, f"report number {item.unsigned}: must be 1 to 255")
            self._globals = replace(state, report_id=item.unsigned)

    def _push_or_pop(self, item: DescriptorItem) -> None:
        if item.tag == TagGlobal.PUSH:
            self._global_stack.append(self._globals)
        elif self._global_stack:
            self._globals = self._global_stack.pop()
        else:
            raise _make_error(item, "Pop without a Push")

    def _apply_local(self, item: DescriptorItem) -> None:
        # A usage with four bytes of data contains its page.
        usage = item.unsigned
        if len(item.data) < 4:
            usage |= self._globals.page << 16
        if item.tag == TagLocal.USAGE:
            self._locals.usage_ranges.append(range(usage, usage + 1))
        elif item.tag == TagLocal.USAGE_MINIMUM:
            self._locals.usage_minimum = usage
        elif item.tag == TagLocal.USAGE_MAXIMUM and self._locals.usage_minimum is not None:
            self._locals.usage_ranges.append(range(self._locals.usage_minimum, usage + 1))


def _make_error(item: DescriptorItem, reason: str) -> DescriptorError:
    return DescriptorError(
        "its report descriptor is invalid at byte {at}: {what}", at=item.position, what=reason
    )
