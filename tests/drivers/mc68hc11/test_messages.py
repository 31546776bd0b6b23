"""What board and host say: every message fits into a frame and comes back as it was."""

from dataclasses import fields

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotemina.drivers.errors import ProtocolError
from rotemina.drivers.mc68hc11.board_messages import Captured, Inputs, Telemetry
from rotemina.drivers.mc68hc11.framing import MAX_PAYLOAD, STOP_TYPE
from rotemina.drivers.mc68hc11.host_messages import MoveVelocity, SetPoint, Stop
from rotemina.drivers.mc68hc11.messages import MESSAGES, message_of
from rotemina.drivers.mc68hc11.segment_window import MOST_WAY

BOUNDS = {
    "B": (0, 2**8),
    "b": (-(2**7), 2**7),
    "H": (0, 2**16),
    "I": (0, 2**32),
    "i": (-(2**31), 2**31),
}


@st.composite
def messages(draw, kind):
    numbers = [draw(st.integers(low, high - 1)) for low, high in map(BOUNDS.get, layout(kind))]
    if len(numbers) < len(fields(kind)):
        numbers.append(draw(st.binary(max_size=MAX_PAYLOAD - kind.LAYOUT.size)))
    return kind(*numbers)


def layout(kind):
    return kind.LAYOUT.format.lstrip(">")


@pytest.mark.parametrize("kind", MESSAGES.values(), ids=lambda kind: kind.__name__)
@given(data=st.data())
def test_a_message_comes_back_as_it_was(kind, data):
    message = data.draw(messages(kind))
    payload = message.packed()
    assert len(payload) <= MAX_PAYLOAD
    assert message_of(kind.TYPE, payload) == message


@pytest.mark.parametrize("kind", MESSAGES.values(), ids=lambda kind: kind.__name__)
def test_a_payload_of_another_length_is_refused(kind):
    size = kind.LAYOUT.size
    has_tail = len(fields(kind)) > len(layout(kind))
    for wrong in {size - 1, size if has_tail else size + 1} - {-1, size if has_tail else -1}:
        with pytest.raises(ProtocolError, match=f"{kind.__name__}: a payload of {wrong} bytes"):
            kind.unpacked(bytes(wrong))


@given(st.integers(0, 255), st.binary(max_size=MAX_PAYLOAD))
def test_any_payload_is_a_message_or_refused(type_, payload):
    try:
        message = message_of(type_, payload)
    except ProtocolError:
        return
    assert message.packed() == payload


def test_numbers_are_packed_as_the_documentation_says():
    assert MoveVelocity(0, -1000, 150).packed().hex(" ") == "00 ff ff fc 18 00 96"
    segment = SetPoint.of(7, 20, [(1, -1), (-2, 256), (3, 0)])
    assert segment.packed().hex(" ", 7) == ("070014 00000001ffffff fffffffe000100 00000003000000")
    assert len(segment.packed()) == MAX_PAYLOAD
    told = Telemetry.of(256, 1, 0, 3, 9, [(-2, 1), (3, 2)])
    assert told.packed().hex(" ") == "00 00 01 00 01 00 03 09 ff ff fe 00 03 00 00 03 ff ff"
    assert Inputs.of(2, [0x123, 0x456, 0x789]).packed().hex() == "02" + "1234567890"
    assert len(Captured(0, bytes(22)).packed()) == MAX_PAYLOAD
    assert Stop.TYPE == STOP_TYPE


@given(
    st.lists(
        st.tuples(st.integers(-(2**23), 2**23 - 1), st.integers(-(2**15), 2**15 - 1)), max_size=3
    )
)
def test_telemetry_tells_readings_and_commands(axes):
    told = Telemetry.of(1, 2, 3, 4, 5, [(reading, reading + by) for reading, by in axes])
    back = message_of(Telemetry.TYPE, told.packed())
    assert back.samples() == tuple((reading, reading + by) for reading, by in axes)


def test_telemetry_clips_a_deviation_and_refuses_a_reading_beyond_its_bits():
    assert Telemetry.of(0, 0, 0, 0, 0, [(0, 100_000), (0, -100_000)]).samples() == (
        (0, 2**15 - 1),
        (0, -(2**15)),
    )
    with pytest.raises(ProtocolError, match="8388608"):
        Telemetry.of(0, 0, 0, 0, 0, [(2**23, 0)])
    with pytest.raises(ProtocolError, match="7 bytes"):
        Telemetry(0, 0, 0, 0, 0, bytes(7)).samples()


@given(
    st.lists(
        st.tuples(st.integers(-(2**31), 2**31 - 1), st.integers(-(2**23), 2**23 - 1)), max_size=3
    )
)
def test_a_segment_tells_its_differences(axes):
    back = message_of(SetPoint.TYPE, SetPoint.of(1, 2, axes).packed())
    assert back.differences() == tuple(axes)


def test_the_farthest_set_points_fit_to_and_fro():
    for way in (MOST_WAY, -MOST_WAY):  # one way and back, or back again
        SetPoint.of(0, 20, [(way + 2 * way, -2 * way), (-2 * way, 2 * way), (way, 0)])


def test_differences_that_do_not_fit_are_refused():
    for axes in ([(1 << 31, 0)], [(0, 1 << 23)]):
        with pytest.raises(ProtocolError, match="32 and 24 bits"):
            SetPoint.of(0, 1, axes)
    with pytest.raises(ProtocolError, match="8 bytes"):
        SetPoint(0, 1, bytes(8)).differences()


@given(st.lists(st.integers(0, 4095), max_size=8), st.integers(0, 255))
def test_inputs_come_back_as_they_were(readings, buttons):
    told = message_of(Inputs.TYPE, Inputs.of(buttons, readings).packed())
    assert told.readings() == tuple(readings)
    assert told.buttons == buttons


def test_a_number_that_does_not_fit_is_refused():
    with pytest.raises(ProtocolError, match=r"MoveVelocity\(axis=0, speed=3000000000"):
        MoveVelocity(0, 3_000_000_000, 150).packed()
