"""Frames on the wire: bytes in, frames out, and back. Pure; ``docs/protocol.md`` is the contract.

A body without zeros, by consistent overhead byte stuffing (Cheshire and Baker, IEEE/ACM Trans.
Networking 7 (1999) 159-172), ends with a zero. A zero so always ends whatever was under way, and a
receiver that wakes up in the middle of a frame is right from the next one on.

To a board, a zero where a frame should begin says *stop*: one byte, at any speed of the line. So
only boards put a zero before a frame; a host that repeats one lets `RESYNC` go ahead of it.
"""

from binascii import crc_hqx
from dataclasses import dataclass
from typing import NamedTuple

from rotemina.drivers.errors import ProtocolError
from rotemina.sim.messages import message

MAX_FRAME = 32  # bytes on the wire, with both zeros
MAX_PAYLOAD = 24
BROADCAST = 0x0F  # the address that every board heeds and none answers
FROM_BOARD = 0x80  # set in the address byte of what a board says
STOP_TYPE = 0x02
STOP_BYTES = b"\0\0"  # the first ends what may be under way; after a frame it is enough
RESYNC = b"\x01\0"  # ends whatever was under way, and is no frame itself
_ADDRESSES = range(1, BROADCAST + 1)
_HEAD = 3  # address, number, type
_CRC = 2
_CRC_START = 0xFFFF
_INVERTED = 0xFFFF  # or a zero that is doubled at the end would go unnoticed
_CRC_OVER_ALL = 0x1D0F  # what the check comes to over itself as well
_END = b"\0"
_MAX_BODY = MAX_FRAME - 2


class Frame(NamedTuple):
    """What is said: by or to which board, the sender's number of it, the type, the payload."""

    address: int
    number: int
    type: int
    payload: bytes = b""
    from_board: bool = False


STOP = Frame(BROADCAST, 0, STOP_TYPE)


def encoded(frame: Frame) -> bytes:
    """Return a frame as it goes over the wire: a zero behind it, and before it if a board speaks.

    Raises
    ------
    ProtocolError
        If a part of it is out of bounds.
    """
    if frame.address not in _ADDRESSES:
        raise ProtocolError(
            message("engine", "frame: address = {address}: must be 1 to {broadcast}").fill(
                address=frame.address, broadcast=BROADCAST
            )
        )
    for name, value in (("number", frame.number), ("type", frame.type)):
        if not 0 <= value <= 0xFF:
            raise ProtocolError(
                message("engine", "frame: {name} = {value}: must be 0 to 255").fill(
                    name=name, value=value
                )
            )
    if len(frame.payload) > MAX_PAYLOAD:
        raise ProtocolError(
            message("engine", "frame: a payload of {count} bytes: at most {max_payload}").fill(
                count=len(frame.payload), max_payload=MAX_PAYLOAD
            )
        )
    who = frame.address | (FROM_BOARD if frame.from_board else 0)
    said = bytes((who, frame.number, frame.type)) + frame.payload
    said += (crc_hqx(said, _CRC_START) ^ _INVERTED).to_bytes(_CRC, "big")
    stuffed = b"".join(bytes((len(part) + 1,)) + part for part in said.split(_END))
    return (_END if frame.from_board else b"") + stuffed + _END


@dataclass(slots=True)
class Decoder:
    """Gathers bytes until they are frames.

    Attributes
    ----------
    of_board : bool
        Whether a board listens: an empty frame is `STOP` to it, and nothing to a host.
    frames, rejected : int
        How many frames were understood, and how many stretches between zeros were none.
    """

    of_board: bool = False
    frames: int = 0
    rejected: int = 0
    _begun: bytes = b""
    _lost: bool = False

    def feed(self, received: bytes) -> list[Frame]:
        """Return the frames that these bytes complete, in order; never raises."""
        *ended, begun = (self._begun + received).split(_END)
        found = []
        for body in ended:
            if self._lost:  # the end of what was too long
                self._lost = False
                continue
            if not body:
                if self.of_board:
                    found.append(STOP)
            else:
                frame = _decoded(body)
                if frame is None:
                    self.rejected += 1
                else:
                    self.frames += 1
                    found.append(frame)
        if len(begun) > _MAX_BODY:
            # Longer than any frame: nothing of it is kept but that its end is still to come.
            self.rejected += not self._lost
            self._lost, begun = True, b""
        self._begun = begun
        return found


def _decoded(body: bytes) -> Frame | None:
    """Return the frame that lay between two zeros, None if it is none."""
    if not _HEAD + _CRC < len(body) <= _MAX_BODY:
        return None
    parts, at = [], 0
    while at < len(body):
        end = at + body[at]
        if end > len(body):
            return None
        parts.append(body[at + 1 : end])
        at = end
    said = _END.join(parts)
    if crc_hqx(said, _CRC_START) != _CRC_OVER_ALL:
        return None
    who = said[0]
    address = who & ~FROM_BOARD
    if address not in _ADDRESSES:
        return None
    return Frame(address, said[1], said[2], said[_HEAD:-_CRC], bool(who & FROM_BOARD))
