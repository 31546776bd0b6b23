"""Conversion between frames and the bytes on the wire, as defined in ``docs/protocol.md``.

The module does no input or output. Consistent overhead byte stuffing (Cheshire and Baker, IEEE/ACM
Trans. Networking 7 (1999) 159-172) removes all zeros from the body of a frame, and a zero ends it.
A zero therefore always ends the current frame. A receiver that starts to listen in the middle of a
frame decodes the next frame correctly.

If a board receives a zero where a frame should begin, it stops. So a stop takes a single byte, at
any baud rate. Therefore only boards put a zero before a frame. A host that repeats a frame sends
`RESYNC_BYTES` before it.
"""

from binascii import crc_hqx
from dataclasses import dataclass
from typing import NamedTuple

from rotemina.drivers.contract import ProtocolError

# Length on the wire, including the zeros at both ends.
MAX_FRAME_BYTES = 32
MAX_PAYLOAD_BYTES = 24
# All boards act on a frame to this address, and none acknowledges it.
BROADCAST_ADDRESS = 0x0F
# This bit is set in the address byte of each frame that a board sends.
FROM_BOARD_BIT = 0x80
STOP_TYPE = 0x02
# The first zero ends a frame that may be in transit, and the second one means stop. After a
# complete frame, the first zero already means stop.
STOP_BYTES = b"\0\0"
# These bytes end an unfinished frame, but are not a frame themselves.
RESYNC_BYTES = b"\x01\0"
_VALID_ADDRESSES = range(1, BROADCAST_ADDRESS + 1)
# Address, number and type.
_HEADER_BYTES = 3
_CRC_BYTES = 2
_CRC_INITIAL = 0xFFFF
# Without this inversion, the CRC would not detect a zero that is doubled at the end.
_CRC_FINAL_XOR = 0xFFFF
# CRC over a valid frame including its own CRC.
_CRC_RESIDUE = 0x1D0F
_DELIMITER = b"\0"
_MAX_BODY_BYTES = MAX_FRAME_BYTES - 2


class SerialFrame(NamedTuple):
    """Frame of the protocol, before byte stuffing.

    Attributes
    ----------
    address : int
        Address of the board that sends or receives the frame, or `BROADCAST_ADDRESS`.
    number : int
        The sender's frame counter.
    type : int
        Type number of the message.
    payload : bytes
    from_board : bool
        Whether a board sends the frame.
    """

    address: int
    number: int
    type: int
    payload: bytes = b""
    from_board: bool = False


STOP_FRAME = SerialFrame(BROADCAST_ADDRESS, 0, STOP_TYPE)


def encode_frame(frame: SerialFrame) -> bytes:
    """Return the bytes of a frame on the wire.

    A zero ends the frame. A frame from a board also begins with a zero.

    Raises
    ------
    ProtocolError
        If the address, the number, the type or the length of the payload is out of bounds.
    """
    if frame.address not in _VALID_ADDRESSES:
        raise ProtocolError(
            "frame: address = {address}: must be 1 to {broadcast}",
            address=frame.address,
            broadcast=BROADCAST_ADDRESS,
        )
    for name, value in (("number", frame.number), ("type", frame.type)):
        if not 0 <= value <= 0xFF:
            raise ProtocolError("frame: {name} = {value}: must be 0 to 255", name=name, value=value)
    if len(frame.payload) > MAX_PAYLOAD_BYTES:
        raise ProtocolError(
            "frame: a payload of {count} bytes: at most {max_payload}",
            count=len(frame.payload),
            max_payload=MAX_PAYLOAD_BYTES,
        )
    address_byte = frame.address | (FROM_BOARD_BIT if frame.from_board else 0)
    body = bytes((address_byte, frame.number, frame.type)) + frame.payload
    body += (crc_hqx(body, _CRC_INITIAL) ^ _CRC_FINAL_XOR).to_bytes(_CRC_BYTES, "big")
    stuffed = b"".join(bytes((len(part) + 1,)) + part for part in body.split(_DELIMITER))
    return (_DELIMITER if frame.from_board else b"") + stuffed + _DELIMITER


@dataclass(slots=True)
class FrameDecoder:
    """Decoder that collects received bytes into complete frames.

    Attributes
    ----------
    is_board : bool
        Whether the receiver is a board. A board reads an empty frame as `STOP_FRAME`, and a host
        ignores it.
    frame_count, rejected_count : int
        Number of valid frames, and of byte sequences between zeros that are not a valid frame.
    """

    is_board: bool = False
    frame_count: int = 0
    rejected_count: int = 0
    _partial_body: bytes = b""
    _is_skipping: bool = False

    def feed(self, received: bytes) -> list[SerialFrame]:
        """Return the frames that these bytes complete, in order. Invalid bytes raise no error."""
        *bodies, partial_body = (self._partial_body + received).split(_DELIMITER)
        frames = []
        for body in bodies:
            if self._is_skipping:
                # These bytes are the end of a sequence that was too long for a frame.
                self._is_skipping = False
                continue
            if not body:
                if self.is_board:
                    frames.append(STOP_FRAME)
            else:
                frame = _decode_body(body)
                if frame is None:
                    self.rejected_count += 1
                else:
                    self.frame_count += 1
                    frames.append(frame)
        if len(partial_body) > _MAX_BODY_BYTES:
            # The sequence is too long for a frame. Drop it, and skip its end when that arrives.
            self.rejected_count += not self._is_skipping
            self._is_skipping, partial_body = True, b""
        self._partial_body = partial_body
        return frames


def _decode_body(body: bytes) -> SerialFrame | None:
    """Return the frame whose stuffed body lies between two zeros, or None if it is not valid."""
    if not _HEADER_BYTES + _CRC_BYTES < len(body) <= _MAX_BODY_BYTES:
        return None
    parts, position = [], 0
    while position < len(body):
        end = position + body[position]
        if end > len(body):
            return None
        parts.append(body[position + 1 : end])
        position = end
    content = _DELIMITER.join(parts)
    if crc_hqx(content, _CRC_INITIAL) != _CRC_RESIDUE:
        return None
    address_byte = content[0]
    address = address_byte & ~FROM_BOARD_BIT
    if address not in _VALID_ADDRESSES:
        return None
    return SerialFrame(
        address,
        content[1],
        content[2],
        content[_HEADER_BYTES:-_CRC_BYTES],
        bool(address_byte & FROM_BOARD_BIT),
    )
