"""What a board and its host say to each other. Pure; ``docs/protocol.md`` is the contract.

Numbers are big-endian, as the MC68HC11 has them. Positions are whole steps of an axis' resolution,
times whole microseconds of the board's own clock.
"""

from collections.abc import Mapping

from rotemina.drivers.errors import ProtocolError
from rotemina.drivers.mc68hc11 import board_messages, host_messages
from rotemina.drivers.mc68hc11.payload import Message
from rotemina.sim.messages import message

MESSAGES: Mapping[int, type[Message]] = {
    one.TYPE: one
    for module in (board_messages, host_messages)
    for one in vars(module).values()
    if isinstance(one, type) and issubclass(one, Message) and one is not Message
}


def message_of(type_: int, payload: bytes) -> Message:
    """Return the message of a frame's type and payload.

    Raises
    ------
    ProtocolError
        If there is no such type, or the payload is none of it.
    """
    known = MESSAGES.get(type_)
    if known is None:
        raise ProtocolError(
            message("engine", "frame of type 0x{type}: not a message of this protocol").fill(
                type=format(type_, "02X")
            )
        )
    return known.unpacked(payload)
