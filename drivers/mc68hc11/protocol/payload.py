"""Base class of all messages: packs its fields into the payload of a frame and unpacks them."""

import struct
from dataclasses import fields
from functools import cache
from struct import Struct
from typing import ClassVar, Self

from rotemina.drivers.contract import ProtocolError
from rotemina.sim.errors import describe_exception


class WireMessage:
    """Message that fits into the payload of one frame.

    ``TYPE`` is the type number of the frame, and ``LAYOUT`` defines how the fields are packed. If
    the last field has the type ``bytes``, it is the rest of the payload. A subclass passes both as
    class arguments, with the layout in the notation of `struct` but without a byte order:
    ``class SetWatchdog(WireMessage, code=0x06, layout="H")``.
    """

    TYPE: ClassVar[int]
    LAYOUT: ClassVar[Struct]
    __slots__ = ()

    def __init_subclass__(cls, *, code: int | None = None, layout: str = "") -> None:
        # With slots, the dataclass decorator creates the class a second time, without arguments.
        if code is not None:
            cls.TYPE, cls.LAYOUT = code, Struct(f">{layout}")

    def pack(self) -> bytes:
        """Return the payload.

        Raises
        ------
        ProtocolError
            If a number does not fit into its field.
        """
        names = [field.name for field in fields(self)]  # type: ignore[arg-type]
        values = [getattr(self, name) for name in names]
        tail = values.pop() if self._has_tail() else b""
        try:
            return self.LAYOUT.pack(*values) + tail
        except struct.error as error:
            raise ProtocolError(
                "{what}: a number does not fit: {error}",
                what=str(self),
                error=describe_exception(error),
            ) from error

    @classmethod
    def unpack(cls, payload: bytes) -> Self:
        """Return the message that a payload contains.

        Raises
        ------
        ProtocolError
            If the payload has the wrong length for this type.
        """
        size, has_tail = cls.LAYOUT.size, cls._has_tail()
        if len(payload) < size or (len(payload) > size and not has_tail):
            more = " or more" if has_tail else ""
            raise ProtocolError(
                "{name}: a payload of {count} bytes: must be {size}{more}",
                name=cls.__name__,
                count=len(payload),
                size=size,
                more=more,
            )
        numbers = cls.LAYOUT.unpack_from(payload)
        values = (*numbers, payload[size:]) if has_tail else numbers
        return cls(*values)

    @classmethod
    @cache
    def _has_tail(cls) -> bool:
        all_fields = fields(cls)  # type: ignore[arg-type]
        return bool(all_fields) and all_fields[-1].type is bytes
