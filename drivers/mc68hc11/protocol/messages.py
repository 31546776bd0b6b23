"""All messages of the protocol by their type number, as defined in ``docs/protocol.md``.

Numbers are big-endian, as in the MC68HC11. Positions are integer multiples of the axis
resolution, and times are whole microseconds of the board's own clock.
"""

from collections.abc import Mapping

from rotemina.drivers.contract import ProtocolError
from rotemina.drivers.mc68hc11.protocol import board_messages, host_messages
from rotemina.drivers.mc68hc11.protocol.payload import WireMessage

MESSAGE_TYPES: Mapping[int, type[WireMessage]] = {
    message_class.TYPE: message_class
    for module in (board_messages, host_messages)
    for message_class in vars(module).values()
    if isinstance(message_class, type)
    and issubclass(message_class, WireMessage)
    and message_class is not WireMessage
}


def unpack_message(type_: int, payload: bytes) -> WireMessage:
    """Decode a frame's payload into the message class of its type number.

    Raises
    ------
    ProtocolError
        If the protocol has no such type, or the payload has the wrong length for it.
    """
    message_class = MESSAGE_TYPES.get(type_)
    if message_class is None:
        raise ProtocolError(
            "frame of type 0x{type}: not a message of this protocol", type=format(type_, "02X")
        )
    return message_class.unpack(payload)
