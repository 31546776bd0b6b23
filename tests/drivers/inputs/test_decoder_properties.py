"""Any valid report is decoded to its values, and damaged bytes do no harm."""

from dataclasses import dataclass

import pytest
from hypothesis import example, given, strategies as st

from rotemina.drivers.contract import DescriptorError
from rotemina.drivers.inputs.hid_decoder import HidDecoder
from rotemina.drivers.inputs.hid_descriptor import ReportDescriptor

PAGE, LOW, HIGH, SIZE, COUNT, NUMBER = 0x04, 0x14, 0x24, 0x74, 0x94, 0x84
USAGE, FIRST, LAST, INPUT = 0x08, 0x18, 0x28, 0x80
CONSTANT, VARIABLE = 0x01, 0x02
MAX_LISTED_BUTTON = 9
JOYSTICK, END = bytes.fromhex("05 01 09 04 A1 01"), b"\xc0"


def encode_item(prefix, value):
    """Return an item whose signed value takes as few bytes as possible."""
    size = next(n for n in (1, 2, 4) if -(1 << 8 * n - 1) <= value < 1 << 8 * n - 1)
    return bytes([prefix | {1: 1, 2: 2, 4: 3}[size]]) + value.to_bytes(size, "little", signed=True)


@dataclass
class InputItem:
    """An input item with its kind, its range, and a value for each element."""

    kind: str
    size: int
    low: int
    high: int
    values: list[int]

    def encode_declaration(self):
        count = len(self.values)
        page, usages, flags = {
            "axes": (0x01, encode_item(USAGE, 0x36) * count, VARIABLE),
            "buttons": (0x09, encode_item(USAGE, 0x14) * count, VARIABLE),
            "list": (0x09, encode_item(FIRST, 1) + encode_item(LAST, MAX_LISTED_BUTTON), 0),
            "vendor": (0x7F00, encode_item(USAGE, 0x20), VARIABLE),  # one usage for all elements
            "padding": (0x01, b"", CONSTANT | VARIABLE),
        }[self.kind]
        range_items = (
            encode_item(PAGE, page) + encode_item(LOW, self.low) + encode_item(HIGH, self.high)
        )
        return (
            range_items
            + encode_item(SIZE, self.size)
            + encode_item(COUNT, count)
            + usages
            + encode_item(INPUT, flags)
        )

    def axes(self):
        if self.kind != "axes":
            return []
        span = self.high - self.low
        return [2.0 * (value - self.low) / span - 1.0 for value in self.values]

    def buttons(self):
        if self.kind == "buttons":
            return [value == 1 for value in self.values]
        if self.kind == "list":
            return [number in self.values for number in range(1, MAX_LISTED_BUTTON + 1)]
        return []


@st.composite
def input_items(draw):
    kind = draw(st.sampled_from(["axes", "buttons", "list", "vendor", "padding"]))
    size = draw({"buttons": st.just(1), "list": st.integers(5, 9)}.get(kind, st.integers(2, 31)))
    low, high = {"buttons": (0, 1), "list": (1, MAX_LISTED_BUTTON)}.get(kind, (0, (1 << size) - 1))
    if kind == "axes" and draw(st.booleans()):
        low, high = -(1 << size - 1), (1 << size - 1) - 1
    # A 0 in a list means that no button is pressed.
    value = st.integers(0 if kind == "list" else low, high)
    return InputItem(kind, size, low, high, draw(st.lists(value, min_size=1, max_size=5)))


def encode_report(items):
    """Return the bytes of a report with the values of its items."""
    bits = "".join(
        format(value & (1 << item.size) - 1, f"0{item.size}b")[::-1]
        for item in items
        for value in item.values
    )
    bits += "0" * (-len(bits) % 8)
    return bytes(int(bits[start : start + 8][::-1], 2) for start in range(0, len(bits), 8))


@given(st.lists(input_items(), min_size=1, max_size=8))
def test_a_report_is_decoded_to_its_values(items):
    descriptor = JOYSTICK + b"".join(item.encode_declaration() for item in items) + END
    axes = [value for item in items for value in item.axes()]
    buttons = [is_pressed for item in items for is_pressed in item.buttons()]
    if not axes and not buttons:
        with pytest.raises(DescriptorError, match="no axis and no button"):
            HidDecoder(ReportDescriptor.parse(descriptor))
        return
    decoder = HidDecoder(ReportDescriptor.parse(descriptor))
    assert len(set(decoder.axes + decoder.buttons)) == len(axes) + len(buttons)
    assert decoder.decode(encode_report(items)) == (tuple(axes), tuple(buttons))


def decode_reports(descriptor, reports):
    """Decode any bytes with any descriptor, and check the number and range of the results."""
    try:
        decoder = HidDecoder(ReportDescriptor.parse(descriptor))
    except DescriptorError:
        return
    for report in reports:
        state = decoder.decode(report)
        if state is not None:
            axes, buttons = state
            assert len(axes) == len(decoder.axes)
            assert len(buttons) == len(decoder.buttons)
            assert not any(abs(axis) > 1.0 for axis in axes)


@given(st.binary(max_size=120), st.lists(st.binary(max_size=80), max_size=5))
@example(bytes.fromhex("05 09 19 00 2B FF FF FF FF 95 01 75 20 81 00"), [bytes(4)])
@example(bytes.fromhex("05 09 15 00 27 FF FF FF 7F 19 00 2B FF FF FF 7F 96 FF 0F 75 08 81 00"), [])
def test_random_bytes_do_no_harm(descriptor, reports):
    decode_reports(descriptor, reports)
    decode_reports(JOYSTICK + descriptor, reports)


VALID_DESCRIPTOR = bytes.fromhex(
    "05 01 09 04 A1 01 85 01 15 81 25 7F 75 08 95 02 09 30 09 31 81 42 75 04 95 01 25 07 15 00"
    "09 39 81 42 05 09 19 01 29 0C 25 01 75 01 95 0C 81 02 15 01 25 0A 19 01 29 0A 75 04 95 03"
    "81 00 A4 B4 C0"
)


@given(
    st.lists(st.tuples(st.integers(0, len(VALID_DESCRIPTOR) - 1), st.integers(0, 255)), max_size=4),
    st.integers(0, len(VALID_DESCRIPTOR)),
    st.lists(st.binary(min_size=1, max_size=12).map(lambda rest: b"\1" + rest), max_size=5),
)
def test_a_damaged_descriptor_does_no_harm(damage, length, reports):
    damaged = bytearray(VALID_DESCRIPTOR)
    for index, byte in damage:
        damaged[index] = byte
    decode_reports(bytes(damaged), reports)
    decode_reports(bytes(damaged[:length]), reports)
