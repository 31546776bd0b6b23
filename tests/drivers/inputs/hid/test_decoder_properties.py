"""For any descriptor: each value that is put in comes out, and no bytes do any harm."""

from dataclasses import dataclass

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rotemina.drivers.inputs.hid.decoder import Decoder
from rotemina.drivers.inputs.hid.descriptor import ReportDescriptor
from rotemina.drivers.inputs.hid.items import DescriptorError

PAGE, LOW, HIGH, SIZE, COUNT, NUMBER = 0x04, 0x14, 0x24, 0x74, 0x94, 0x84
USAGE, FIRST, LAST, INPUT = 0x08, 0x18, 0x28, 0x80
CONSTANT, VARIABLE = 0x01, 0x02
LISTED = 9
JOYSTICK, END = bytes.fromhex("05 01 09 04 A1 01"), b"\xc0"


def item(prefix, value):
    """An item with as few bytes of data as its value fits in, signed."""
    size = next(n for n in (1, 2, 4) if -(1 << 8 * n - 1) <= value < 1 << 8 * n - 1)
    return bytes([prefix | {1: 1, 2: 2, 4: 3}[size]]) + value.to_bytes(size, "little", signed=True)


@dataclass
class Piece:
    """One input item: what it is, its range, and a value for each element."""

    kind: str
    size: int
    low: int
    high: int
    values: list[int]

    def declared(self):
        count = len(self.values)
        page, usages, flags = {
            "axes": (0x01, item(USAGE, 0x36) * count, VARIABLE),
            "buttons": (0x09, item(USAGE, 0x14) * count, VARIABLE),
            "list": (0x09, item(FIRST, 1) + item(LAST, LISTED), 0),
            "vendor": (0x7F00, item(USAGE, 0x20), VARIABLE),  # one usage for all elements
            "padding": (0x01, b"", CONSTANT | VARIABLE),
        }[self.kind]
        ranged = item(PAGE, page) + item(LOW, self.low) + item(HIGH, self.high)
        return ranged + item(SIZE, self.size) + item(COUNT, count) + usages + item(INPUT, flags)

    def axes(self):
        if self.kind != "axes":
            return []
        span = self.high - self.low
        return [2.0 * (value - self.low) / span - 1.0 for value in self.values]

    def buttons(self):
        if self.kind == "buttons":
            return [value == 1 for value in self.values]
        if self.kind == "list":
            return [number in self.values for number in range(1, LISTED + 1)]
        return []


@st.composite
def pieces(draw):
    kind = draw(st.sampled_from(["axes", "buttons", "list", "vendor", "padding"]))
    size = draw({"buttons": st.just(1), "list": st.integers(5, 9)}.get(kind, st.integers(2, 31)))
    low, high = {"buttons": (0, 1), "list": (1, LISTED)}.get(kind, (0, (1 << size) - 1))
    if kind == "axes" and draw(st.booleans()):
        low, high = -(1 << size - 1), (1 << size - 1) - 1
    # 0 in a list: nothing in this place
    value = st.integers(0 if kind == "list" else low, high)
    return Piece(kind, size, low, high, draw(st.lists(value, min_size=1, max_size=5)))


def sent(parts):
    """The bytes of a report with the values of its pieces."""
    bits = "".join(
        format(value & (1 << part.size) - 1, f"0{part.size}b")[::-1]
        for part in parts
        for value in part.values
    )
    bits += "0" * (-len(bits) % 8)
    return bytes(int(bits[at : at + 8][::-1], 2) for at in range(0, len(bits), 8))


@given(st.lists(pieces(), min_size=1, max_size=8))
def test_what_is_put_in_comes_out(parts):
    descriptor = JOYSTICK + b"".join(part.declared() for part in parts) + END
    axes = [value for part in parts for value in part.axes()]
    buttons = [held for part in parts for held in part.buttons()]
    if not axes and not buttons:
        with pytest.raises(DescriptorError, match="no axis and no button"):
            Decoder(ReportDescriptor.parse(descriptor))
        return
    decoder = Decoder(ReportDescriptor.parse(descriptor))
    assert len(set(decoder.axes + decoder.buttons)) == len(axes) + len(buttons)
    assert decoder.decode(sent(parts)) == (tuple(axes), tuple(buttons))


@given(st.lists(st.lists(pieces(), min_size=1, max_size=3), min_size=2, max_size=4))
def test_reports_are_told_apart_by_their_numbers(reports):
    for report in reports:
        report.append(Piece("buttons", 1, 0, 1, [1]))  # each has something to tell
    descriptor = JOYSTICK
    for number, parts in enumerate(reports, 1):
        descriptor += item(NUMBER, number) + b"".join(part.declared() for part in parts)
    decoder = Decoder(ReportDescriptor.parse(descriptor + END))
    for number, parts in enumerate(reports, 1):
        axes, buttons = decoder.decode(bytes([number]) + sent(parts))
        told = [value for part in parts for value in part.axes()]
        # An axis in several reports is one, so this report's are the first of as many.
        assert list(axes[: len(told)]) == told
        assert sum(buttons) >= sum(any(part.buttons()) for part in parts)
    assert decoder.ignored.unknown == decoder.ignored.short == decoder.ignored.long == 0


def use(descriptor, reports):
    """Decode reports by a descriptor, whatever both are; return the decoder, if there is one."""
    try:
        decoder = Decoder(ReportDescriptor.parse(descriptor))
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
    use(descriptor, reports)
    use(JOYSTICK + descriptor, reports)


SOUND = bytes.fromhex(
    "05 01 09 04 A1 01 85 01 15 81 25 7F 75 08 95 02 09 30 09 31 81 42 75 04 95 01 25 07 15 00"
    "09 39 81 42 05 09 19 01 29 0C 25 01 75 01 95 0C 81 02 15 01 25 0A 19 01 29 0A 75 04 95 03"
    "81 00 A4 B4 C0"
)


@given(
    st.lists(st.tuples(st.integers(0, len(SOUND) - 1), st.integers(0, 255)), max_size=4),
    st.integers(0, len(SOUND)),
    st.lists(st.binary(min_size=1, max_size=12).map(lambda rest: b"\1" + rest), max_size=5),
)
def test_a_damaged_descriptor_does_no_harm(damage, end, reports):
    damaged = bytearray(SOUND)
    for at, byte in damage:
        damaged[at] = byte
    use(bytes(damaged), reports)
    use(bytes(damaged[:end]), reports)
