"""Every message of board and host fits into a frame and is unpacked unchanged."""

from dataclasses import fields

import pytest
from hypothesis import given, settings, strategies as st

from rotemina.drivers.contract import ProtocolError
from rotemina.drivers.mc68hc11.protocol import (
    MAX_PAYLOAD_BYTES,
    AskKind,
    BoardKind,
    CaptureSamples,
    MoveVelocity,
    OperatorInputs,
    StopBoard,
    StreamSegment,
    Telemetry,
    unpack_message,
)
from rotemina.drivers.mc68hc11.protocol.framing import STOP_TYPE
from rotemina.drivers.mc68hc11.protocol.messages import MESSAGE_TYPES
from rotemina.drivers.mc68hc11.segment_window import MAX_SETPOINT_DISTANCE_STEPS

BOUNDS = {
    "B": (0, 2**8),
    "b": (-(2**7), 2**7),
    "H": (0, 2**16),
    "I": (0, 2**32),
    "i": (-(2**31), 2**31),
}


@st.composite
def messages(draw, kind):
    numbers = [draw(st.integers(low, high - 1)) for low, high in map(BOUNDS.get, read_format(kind))]
    if len(numbers) < len(fields(kind)):
        numbers.append(draw(st.binary(max_size=MAX_PAYLOAD_BYTES - kind.LAYOUT.size)))
    return kind(*numbers)


def read_format(kind):
    return kind.LAYOUT.format.lstrip(">")


@settings(max_examples=400)
@given(data=st.data(), kind=st.sampled_from(list(MESSAGE_TYPES.values())))
def test_a_message_is_unpacked_unchanged(data, kind):
    message = data.draw(messages(kind))
    payload = message.pack()
    assert len(payload) <= MAX_PAYLOAD_BYTES
    assert unpack_message(kind.TYPE, payload) == message


def test_a_payload_of_wrong_length_is_refused():
    for kind in MESSAGE_TYPES.values():
        size = kind.LAYOUT.size
        has_tail = len(fields(kind)) > len(read_format(kind))
        for wrong_size in ({size - 1} if has_tail else {size - 1, size + 1}) - {-1}:
            message = f"{kind.__name__}: a payload of {wrong_size} bytes"
            with pytest.raises(ProtocolError, match=message):
                kind.unpack(bytes(wrong_size))


@given(st.integers(0, 255), st.binary(max_size=MAX_PAYLOAD_BYTES))
def test_any_payload_is_a_message_or_refused(type_, payload):
    try:
        message = unpack_message(type_, payload)
    except ProtocolError:
        return
    assert message.pack() == payload


def test_numbers_are_packed_as_documented():
    assert MoveVelocity(0, -1000, 150).pack().hex(" ") == "00 ff ff fc 18 00 96"
    segment = StreamSegment.from_differences(7, 20, [(1, -1), (-2, 256), (3, 0)])
    assert segment.pack().hex(" ", 7) == ("070014 00000001ffffff fffffffe000100 00000003000000")
    assert len(segment.pack()) == MAX_PAYLOAD_BYTES
    telemetry = Telemetry.from_samples(256, 1, 0, 3, 9, [(-2, 1), (3, 2)])
    assert telemetry.pack().hex(" ") == "00 00 01 00 01 00 03 09 ff ff fe 00 03 00 00 03 ff ff"
    assert (
        OperatorInputs.from_readings(2, [0x123, 0x456, 0x789]).pack().hex() == "02" + "1234567890"
    )
    assert len(CaptureSamples(0, bytes(22)).pack()) == MAX_PAYLOAD_BYTES
    assert StopBoard.TYPE == STOP_TYPE
    assert (AskKind().pack(), BoardKind(b"virtual").pack()) == (b"", b"virtual")


@given(
    st.lists(
        st.tuples(st.integers(-(2**23), 2**23 - 1), st.integers(-(2**15), 2**15 - 1)), max_size=3
    )
)
def test_telemetry_contains_readings_and_commands(axes):
    samples = tuple((reading, reading + deviation) for reading, deviation in axes)
    telemetry = Telemetry.from_samples(1, 2, 3, 4, 5, samples)
    assert unpack_message(Telemetry.TYPE, telemetry.pack()).unpack_samples() == samples


def test_telemetry_clips_a_deviation_and_refuses_a_reading_beyond_its_bits():
    telemetry = Telemetry.from_samples(0, 0, 0, 0, 0, [(0, 100_000), (0, -100_000)])
    assert telemetry.unpack_samples() == ((0, 2**15 - 1), (0, -(2**15)))
    with pytest.raises(ProtocolError, match="8388608"):
        Telemetry.from_samples(0, 0, 0, 0, 0, [(2**23, 0)])
    with pytest.raises(ProtocolError, match="7 bytes"):
        Telemetry(0, 0, 0, 0, 0, bytes(7)).unpack_samples()


@given(
    st.lists(
        st.tuples(st.integers(-(2**31), 2**31 - 1), st.integers(-(2**23), 2**23 - 1)), max_size=3
    )
)
def test_a_segment_contains_its_differences(axes):
    received = unpack_message(StreamSegment.TYPE, StreamSegment.from_differences(1, 2, axes).pack())
    assert received.unpack_differences() == tuple(axes)


def test_the_longest_motion_forth_and_back_fits_into_a_segment():
    for steps in (MAX_SETPOINT_DISTANCE_STEPS, -MAX_SETPOINT_DISTANCE_STEPS):
        forth_and_back, back_and_forth = (steps + 2 * steps, -2 * steps), (-2 * steps, 2 * steps)
        StreamSegment.from_differences(0, 20, [forth_and_back, back_and_forth, (steps, 0)])


def test_differences_that_do_not_fit_are_refused():
    for axes in ([(1 << 31, 0)], [(0, 1 << 23)]):
        with pytest.raises(ProtocolError, match="32 and 24 bits"):
            StreamSegment.from_differences(0, 1, axes)
    with pytest.raises(ProtocolError, match="8 bytes"):
        StreamSegment(0, 1, bytes(8)).unpack_differences()


@given(st.lists(st.integers(0, 4095), max_size=8), st.integers(0, 255))
def test_inputs_are_unpacked_unchanged(readings, buttons):
    inputs = unpack_message(
        OperatorInputs.TYPE, OperatorInputs.from_readings(buttons, readings).pack()
    )
    assert inputs.unpack_readings() == tuple(readings)
    assert inputs.buttons == buttons


def test_a_number_that_does_not_fit_is_refused():
    with pytest.raises(ProtocolError, match=r"MoveVelocity\(axis=0, speed=3000000000"):
        MoveVelocity(0, 3_000_000_000, 150).pack()
