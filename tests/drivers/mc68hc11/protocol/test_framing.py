"""Every frame on the wire is decoded, and nothing else becomes a frame."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.drivers.contract import ProtocolError
from rotemina.drivers.mc68hc11.protocol import (
    BROADCAST_ADDRESS,
    MAX_FRAME_BYTES,
    MAX_PAYLOAD_BYTES,
    RESYNC_BYTES,
    STOP_BYTES,
    STOP_FRAME,
    FrameDecoder,
    SerialFrame,
    encode_frame,
)

frames = st.builds(
    SerialFrame,
    address=st.integers(1, BROADCAST_ADDRESS),
    number=st.integers(0, 255),
    type=st.integers(0, 255),
    payload=st.binary(max_size=MAX_PAYLOAD_BYTES),
    from_board=st.booleans(),
)


def compute_documented_crc(data):
    """Compute the check bit by bit, as docs/protocol.md describes it."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc ^ 0xFFFF


@given(frames)
def test_a_frame_is_decoded_unchanged(frame):
    wire = encode_frame(frame)
    assert len(wire) <= MAX_FRAME_BYTES
    assert wire[-1] == 0
    assert (wire[0] == 0) == frame.from_board
    assert 0 not in wire[1:-1]
    assert FrameDecoder().feed(wire) == [frame]
    if not frame.from_board:
        assert FrameDecoder(is_board=True).feed(wire) == [frame]


def test_the_documented_example_is_correct():
    frame = SerialFrame(1, 7, 0x11, bytes.fromhex("00000003e80096"))
    body = bytes((1, 7, 0x11)) + frame.payload
    crc = compute_documented_crc(body)
    assert crc == 0xCB7C
    # 01 07 11 | 00 | 00 | 00 | 03 e8 | 00 96 cb 7c, with each zero as the distance to the next one
    assert encode_frame(frame).hex(" ") == "04 01 07 11 01 01 03 03 e8 04 96 cb 7c 00"


@given(st.lists(frames, max_size=8), st.data())
def test_frames_arrive_in_pieces_of_any_length(sent_frames, data):
    wire = b"".join(map(encode_frame, sent_frames))
    decoder, received_frames = FrameDecoder(), []
    while wire:
        size = data.draw(st.integers(1, 40))
        received_frames += decoder.feed(wire[:size])
        wire = wire[size:]
    assert received_frames == sent_frames
    assert decoder.rejected_count == 0


@given(frames, st.binary(max_size=200), frames)
def test_garbage_between_frames_loses_no_frame(first, garbage, second):
    resync_bytes = b"" if second.from_board else RESYNC_BYTES
    received_frames = FrameDecoder().feed(
        encode_frame(first) + garbage + resync_bytes + encode_frame(second)
    )
    assert received_frames[0] == first
    assert received_frames[-1] == second


@given(st.lists(frames.map(lambda frame: frame._replace(from_board=False)), max_size=5))
def test_frames_never_stop_a_board_but_one_extra_zero_does(sent_frames):
    decoder = FrameDecoder(is_board=True)
    assert decoder.feed(b"".join(map(encode_frame, sent_frames))) == sent_frames
    assert decoder.feed(b"\0") == [STOP_FRAME]


@given(frames, st.integers(0, MAX_FRAME_BYTES))
def test_a_stop_works_in_the_middle_of_any_frame(frame, byte_count):
    decoder = FrameDecoder(is_board=True)
    decoder.feed(encode_frame(frame._replace(from_board=False))[:byte_count])
    assert decoder.feed(STOP_BYTES)[-1] == STOP_FRAME
    assert decoder.feed(RESYNC_BYTES + encode_frame(frame))[-1] == frame


def test_a_disconnected_line_stops_the_board():
    assert FrameDecoder(is_board=True).feed(bytes(50))[0] == STOP_FRAME
    # A host just waits for the next frame.
    assert FrameDecoder().feed(bytes(50)) == []


@given(frames, st.data())
def test_a_changed_byte_never_makes_another_frame(frame, data):
    wire = bytearray(encode_frame(frame))
    place = data.draw(st.integers(0, len(wire) - 1))
    wire[place] ^= data.draw(st.integers(1, 255))
    assert all(received == frame for received in FrameDecoder().feed(bytes(wire)))


@given(frames, st.data())
def test_a_lost_or_repeated_byte_never_makes_another_frame(frame, data):
    wire = encode_frame(frame)
    place = data.draw(st.integers(0, len(wire) - 1))
    for faulty in (wire[:place] + wire[place + 1 :], wire[: place + 1] + wire[place:]):
        assert all(received == frame for received in FrameDecoder().feed(faulty))


def test_noise_is_almost_never_a_frame():
    generator, decoder = np.random.default_rng(1), FrameDecoder()
    for _ in range(2000):
        decoder.feed(generator.bytes(100))
    # One sequence in 65536 passes the check, if it is long enough.
    assert decoder.frame_count <= 2
    assert decoder.rejected_count > 100


def test_an_endless_frame_takes_no_memory():
    decoder = FrameDecoder()
    for _ in range(1000):
        assert decoder.feed(b"\x55" * 1000) == []
    assert len(decoder._partial_body) <= MAX_FRAME_BYTES
    assert decoder.rejected_count == 1
    frame = SerialFrame(1, 2, 3)
    assert decoder.feed(RESYNC_BYTES + encode_frame(frame)) == [frame]


@pytest.mark.parametrize(
    ("frame", "words"),
    [
        (SerialFrame(0, 0, 0), ["address = 0", "1 to 15"]),
        (SerialFrame(16, 0, 0), ["address = 16"]),
        (SerialFrame(1, 256, 0), ["number = 256"]),
        (SerialFrame(1, 0, -1), ["type = -1"]),
        (SerialFrame(1, 0, 0, bytes(25)), ["25 bytes", "at most 24"]),
    ],
)
def test_an_invalid_frame_is_refused(frame, words):
    with pytest.raises(ProtocolError) as error:
        encode_frame(frame)
    assert all(word in str(error.value) for word in words)
