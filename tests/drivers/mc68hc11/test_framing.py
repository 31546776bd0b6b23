"""Frames on the wire: every one comes through, and nothing else does."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.drivers.errors import ProtocolError
from rotemina.drivers.mc68hc11.framing import (
    BROADCAST,
    MAX_FRAME,
    MAX_PAYLOAD,
    RESYNC,
    STOP,
    STOP_BYTES,
    Decoder,
    Frame,
    encoded,
)

frames = st.builds(
    Frame,
    address=st.integers(1, BROADCAST),
    number=st.integers(0, 255),
    type=st.integers(0, 255),
    payload=st.binary(max_size=MAX_PAYLOAD),
    from_board=st.booleans(),
)


def crc_as_documented(said):
    """The check as docs/protocol.md has it, bit by bit."""
    crc = 0xFFFF
    for byte in said:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc ^ 0xFFFF


@given(frames)
def test_a_frame_comes_back_as_it_was(frame):
    wire = encoded(frame)
    assert len(wire) <= MAX_FRAME
    assert wire[-1] == 0
    assert (wire[0] == 0) == frame.from_board
    assert 0 not in wire[1:-1]
    assert Decoder().feed(wire) == [frame]
    if not frame.from_board:
        assert Decoder(of_board=True).feed(wire) == [frame]


def test_the_example_of_the_documentation():
    frame = Frame(1, 7, 0x11, bytes.fromhex("00000003e80096"))
    said = bytes((1, 7, 0x11)) + frame.payload
    check = crc_as_documented(said)
    assert check == 0xCB7C
    # 01 07 11 | 00 | 00 | 00 | 03 e8 | 00 96 cb 7c, each zero by the way to the next one
    assert encoded(frame).hex(" ") == "04 01 07 11 01 01 03 03 e8 04 96 cb 7c 00"


@given(st.lists(frames, max_size=8), st.data())
def test_frames_come_through_in_pieces_of_any_length(sent, data):
    wire = b"".join(map(encoded, sent))
    decoder, found = Decoder(), []
    while wire:
        size = data.draw(st.integers(1, 40))
        found += decoder.feed(wire[:size])
        wire = wire[size:]
    assert found == sent
    assert decoder.rejected == 0


@given(frames, st.binary(max_size=200), frames)
def test_whatever_garbage_lies_between_no_frame_is_lost(first, garbage, second):
    again = b"" if second.from_board else RESYNC
    found = Decoder().feed(encoded(first) + garbage + again + encoded(second))
    assert found[0] == first
    assert found[-1] == second


@given(st.lists(frames.map(lambda one: one._replace(from_board=False)), max_size=5))
def test_frames_alone_never_stop_a_board_and_one_byte_more_does(sent):
    decoder = Decoder(of_board=True)
    assert decoder.feed(b"".join(map(encoded, sent))) == sent
    assert decoder.feed(b"\0") == [STOP]


@given(frames, st.integers(0, MAX_FRAME))
def test_a_stop_is_heard_in_the_middle_of_any_frame(frame, heard):
    decoder = Decoder(of_board=True)
    decoder.feed(encoded(frame._replace(from_board=False))[:heard])
    assert decoder.feed(STOP_BYTES)[-1] == STOP
    assert decoder.feed(RESYNC + encoded(frame))[-1] == frame


def test_a_line_torn_off_stops_the_board():
    assert Decoder(of_board=True).feed(bytes(50))[0] == STOP
    assert Decoder().feed(bytes(50)) == []  # a host waits for what comes


@given(frames, st.data())
def test_a_byte_that_was_changed_is_never_taken_for_another_frame(frame, data):
    wire = bytearray(encoded(frame))
    place = data.draw(st.integers(0, len(wire) - 1))
    wire[place] ^= data.draw(st.integers(1, 255))
    assert all(one == frame for one in Decoder().feed(bytes(wire)))


@given(frames, st.data())
def test_a_byte_that_was_lost_or_doubled_makes_no_other_frame(frame, data):
    wire = encoded(frame)
    place = data.draw(st.integers(0, len(wire) - 1))
    for faulty in (wire[:place] + wire[place + 1 :], wire[: place + 1] + wire[place:]):
        assert all(one == frame for one in Decoder().feed(faulty))


def test_noise_alone_is_hardly_ever_a_frame():
    chance, decoder = np.random.default_rng(1), Decoder()
    for _ in range(2000):
        decoder.feed(chance.bytes(100))
    # One stretch in 65536 passes the check, of those that are long enough.
    assert decoder.frames <= 2
    assert decoder.rejected > 100


def test_a_line_that_never_ends_takes_no_memory():
    decoder = Decoder()
    for _ in range(1000):
        assert decoder.feed(b"\x55" * 1000) == []
    assert len(decoder._begun) <= MAX_FRAME
    assert decoder.rejected == 1
    frame = Frame(1, 2, 3)
    assert decoder.feed(RESYNC + encoded(frame)) == [frame]


@pytest.mark.parametrize(
    ("frame", "words"),
    [
        (Frame(0, 0, 0), ["address = 0", "1 to 15"]),
        (Frame(16, 0, 0), ["address = 16"]),
        (Frame(1, 256, 0), ["number = 256"]),
        (Frame(1, 0, -1), ["type = -1"]),
        (Frame(1, 0, 0, bytes(25)), ["25 bytes", "at most 24"]),
    ],
)
def test_what_cannot_be_a_frame_is_refused(frame, words):
    with pytest.raises(ProtocolError) as error:
        encoded(frame)
    assert all(word in str(error.value) for word in words)
