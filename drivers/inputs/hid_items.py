"""The items of a HID report descriptor (HID 1.11, section 6.2.2)."""

from collections.abc import Iterator
from dataclasses import dataclass

from rotemina.drivers.contract import DescriptorError

_LONG_ITEM_PREFIX = 0xFE
_DATA_SIZES_BYTES = (0, 1, 2, 4)


@dataclass(frozen=True, slots=True)
class DescriptorItem:
    """One item: its offset in the descriptor in bytes, its type and tag, and 0 to 4 data bytes."""

    position: int
    type: int
    tag: int
    data: bytes

    @property
    def unsigned(self) -> int:
        """The data as an unsigned number; 0 without data."""
        return int.from_bytes(self.data, "little")

    @property
    def signed(self) -> int:
        """The data as a number in two's complement; 0 without data."""
        return int.from_bytes(self.data, "little", signed=True)


def parse_items(descriptor: bytes) -> Iterator[DescriptorItem]:
    """Yield the short items of a descriptor. Long items are skipped, because HID defines none.

    Raises
    ------
    DescriptorError
        If the last short item is truncated.
    """
    position = 0
    while position < len(descriptor):
        prefix = descriptor[position]
        if prefix == _LONG_ITEM_PREFIX:
            position += 3 + (descriptor[position + 1] if position + 1 < len(descriptor) else 0)
            continue
        size = _DATA_SIZES_BYTES[prefix & 0b11]
        data = descriptor[position + 1 : position + 1 + size]
        if len(data) < size:
            raise DescriptorError(
                "its report descriptor is truncated: the item at byte {at} of {count} needs "
                "{size} bytes of data",
                at=position,
                count=len(descriptor),
                size=size,
            )
        yield DescriptorItem(position, prefix >> 2 & 0b11, prefix >> 4, data)
        position += 1 + size
