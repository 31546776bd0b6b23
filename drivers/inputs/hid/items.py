"""The items of a HID report descriptor (HID 1.11, section 6.2.2)."""

from collections.abc import Iterator
from dataclasses import dataclass

from rotemina.drivers.errors import DriverError
from rotemina.sim.messages import message

_LONG = 0xFE
_DATA_BYTES = (0, 1, 2, 4)


class DescriptorError(DriverError):
    """A report descriptor that cannot be read."""


@dataclass(frozen=True, slots=True)
class Item:
    """One item: its position, type and tag, and 0 to 4 bytes of data."""

    at: int
    type: int
    tag: int
    data: bytes

    @property
    def unsigned(self) -> int:
        """The data as a number of 0 or more; no data is 0."""
        return int.from_bytes(self.data, "little")

    @property
    def signed(self) -> int:
        """The data as two's complement; no data is 0."""
        return int.from_bytes(self.data, "little", signed=True)


def items(descriptor: bytes) -> Iterator[Item]:
    """Yield the short items of a descriptor; long ones are skipped, because none is defined.

    Raises
    ------
    DescriptorError
        If the last item is cut off.
    """
    at = 0
    while at < len(descriptor):
        prefix = descriptor[at]
        if prefix == _LONG:
            at += 3 + (descriptor[at + 1] if at + 1 < len(descriptor) else 0)
            continue
        size = _DATA_BYTES[prefix & 0b11]
        data = descriptor[at + 1 : at + 1 + size]
        if len(data) < size:
            raise DescriptorError(
                message(
                    "engine",
                    "its report descriptor is truncated: byte {at} of {count} begins an item "
                    "with {size} bytes of data",
                ).fill(at=at, count=len(descriptor), size=size)
            )
        yield Item(at, prefix >> 2 & 0b11, prefix >> 4, data)
        at += 1 + size
