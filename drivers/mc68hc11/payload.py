"""A message: numbers packed into the payload of one frame, and back."""

import struct
from dataclasses import fields
from functools import cache
from struct import Struct
from typing import ClassVar, Self

from rotemina.drivers.errors import ProtocolError
from rotemina.sim.errors import reason_of
from rotemina.sim.messages import message


class Message:
    """Something that fits into the payload of one frame.

    ``TYPE`` is the frame's, ``LAYOUT`` how the fields are packed; a last field of bytes takes
    what is left of the payload. A subclass gives both, the layout without its byte order:
    ``class Watch(Message, code=0x06, layout="H")``.
    """

    TYPE: ClassVar[int]
    LAYOUT: ClassVar[Struct]
    __slots__ = ()

    def __init_subclass__(cls, *, code: int | None = None, layout: str = "") -> None:
        if code is not None:  # a dataclass with slots is made twice, then without arguments
            cls.TYPE, cls.LAYOUT = code, Struct(f">{layout}")

    def packed(self) -> bytes:
        """Return the payload.

        Raises
        ------
        ProtocolError
            If a number does not fit where it goes.
        """
        names = [field.name for field in fields(self)]  # type: ignore[arg-type]
        values = [getattr(self, name) for name in names]
        tail = values.pop() if self._has_tail() else b""
        try:
            return self.LAYOUT.pack(*values) + tail
        except struct.error as error:
            raise ProtocolError(
                message("engine", "{what}: a number does not fit: {error}").fill(
                    what=str(self), error=reason_of(error)
                )
            ) from error

    @classmethod
    def unpacked(cls, payload: bytes) -> Self:
        """Return the message that a payload holds.

        Raises
        ------
        ProtocolError
            If it is none of this type.
        """
        size, tail = cls.LAYOUT.size, cls._has_tail()
        if len(payload) < size or (len(payload) > size and not tail):
            more = " or more" if tail else ""
            raise ProtocolError(
                message("engine", "{name}: a payload of {count} bytes: must be {size}{more}").fill(
                    name=cls.__name__, count=len(payload), size=size, more=more
                )
            )
        numbers = cls.LAYOUT.unpack_from(payload)
        values = (*numbers, payload[size:]) if tail else numbers
        return cls(*values)

    @classmethod
    @cache
    def _has_tail(cls) -> bool:
        own = fields(cls)  # type: ignore[arg-type]
        return bool(own) and own[-1].type is bytes
