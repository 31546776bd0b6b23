"""Reports become deflections and buttons by the descriptor alone, bit for bit."""

import warnings
from math import isnan

import hid_parser
import pytest

from rotemina.drivers.inputs.hid.decoder import Decoder, Ignored
from rotemina.drivers.inputs.hid.descriptor import ReportDescriptor
from rotemina.drivers.inputs.hid.items import DescriptorError


def decoder_of(descriptor):
    return Decoder(ReportDescriptor.parse(descriptor))


def decoded(decoder, report):
    axes, buttons = decoder.decode(bytes(report))
    held = {name for name, is_held in zip(decoder.buttons, buttons, strict=True) if is_held}
    return dict(zip(decoder.axes, axes, strict=True)), held


def test_a_classic_joystick(descriptors):
    decoder = decoder_of(descriptors["joystick"])
    assert decoder.axes == ("X", "Y", "Hat right", "Hat towards", "Rz", "Slider")
    assert decoder.buttons == tuple(f"Button {number}" for number in range(1, 13))
    # x 1023, y 0, hat 2 (right), twist 255, buttons 1 and 8, throttle 0, button 12
    report = (1023 | 0 << 10 | 2 << 20 | 255 << 24 | 0x81 << 32 | 0 << 40 | 8 << 48).to_bytes(
        7, "little"
    )
    axes, held = decoded(decoder, report)
    assert axes == {
        "X": 1.0,
        "Y": -1.0,
        "Hat right": 1.0,
        "Hat towards": 0.0,
        "Rz": 1.0,
        "Slider": -1.0,
    }
    assert held == {"Button 1", "Button 8", "Button 12"}


def test_a_gamepad_with_the_vendors_own_in_the_middle(descriptors):
    decoder = decoder_of(descriptors["gamepad"])
    assert decoder.axes == ("X", "Y", "Z", "Rz", "Hat right", "Hat towards", "Rx", "Ry")
    assert len(decoder.buttons) == 14
    report = [1, 255, 0, 0, 255, 0x18, 0, 0x02 | 0x3F << 2, 51, 255, *[0xA5] * 54]
    axes, held = decoded(decoder, report)
    assert [axes[name] for name in ("X", "Y", "Z", "Rz", "Ry")] == [1.0, -1.0, -1.0, 1.0, 1.0]
    assert axes["Rx"] == pytest.approx(2 * 51 / 255 - 1, abs=1e-15)
    assert held == {"Button 1", "Button 14"}  # and nothing of the vendor's
    assert (axes["Hat right"], axes["Hat towards"]) == (0.0, 0.0)  # 8: the null state


def test_triggers_on_the_simulation_page(descriptors):
    decoder = decoder_of(descriptors["triggers"])
    assert decoder.axes == (
        *("X", "Y", "Z", "Rz", "Brake", "Accelerator", "Hat right", "Hat towards"),
    )
    report = [1, 0, 0, 255, 255, 0, 128, 0, 0, 255, 3, 0, 0, 8, 0x02, 0x40, 1]
    axes, held = decoded(decoder, report)
    assert [axes[name] for name in ("X", "Y", "Brake", "Accelerator")] == [-1.0, 1.0, 1.0, -1.0]
    assert axes["Z"] == pytest.approx(0.0, abs=2 / 65535)
    assert (axes["Hat right"], axes["Hat towards"]) == (-1.0, -1.0)  # 8 of 1 to 8: up left
    assert held == {"Button 2", "Button 15"}


def test_six_axes_in_two_reports(descriptors):
    decoder = decoder_of(descriptors["six axes"])
    assert decoder.axes == ("X", "Y", "Z", "Rx", "Ry", "Rz")
    axes, _ = decoded(decoder, [1, 0x5E, 0x01, 0xA2, 0xFE, 0, 0])
    assert [axes[name] for name in "XYZ"] == [1.0, -1.0, 0.0]
    assert all(isnan(axes[name]) for name in ("Rx", "Ry", "Rz"))  # nowhere yet, not centred
    axes, _ = decoded(decoder, [2, 0, 0, 0, 0, 0xAF, 0x00])
    assert list(axes.values()) == [1.0, -1.0, 0.0, 0.0, 0.0, 0.5]
    axes, held = decoded(decoder, [3, 2, 0])
    assert held == {"Button 2"}
    assert list(axes.values()) == [1.0, -1.0, 0.0, 0.0, 0.0, 0.5]


def test_a_list_of_buttons_and_odd_encodings(descriptors):
    decoder = decoder_of(descriptors["list"])
    assert decoder.axes == ("X", "Y", "Slider")
    assert decoder.buttons == tuple(f"Button {number}" for number in range(1, 11))
    axes, held = decoded(decoder, [1, 0xA3, 0x00, 0x81, 0x7F, 255])
    assert held == {"Button 3", "Button 10"}
    assert axes == {"X": -1.0, "Y": 1.0, "Slider": 1.0}
    axes, held = decoded(decoder, [1, 0x03, 0x00, 0x80, 0, 0])
    assert held == {"Button 3"}  # what is no longer listed is released
    assert axes == {"X": -1.0, "Y": 0.0, "Slider": -1.0}  # -128, beyond what is declared
    assert decoder.decode(bytes([2, 255])) is None  # the keyboard's report
    assert decoder.ignored == Ignored(unknown=1)


@pytest.mark.parametrize(
    ("value", "direction"),
    [
        *zip(
            range(8),
            [(0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1)],
            strict=True,
        ),
        (8, (0, 0)),
        (15, (0, 0)),
    ],
)
def test_a_hat_points_in_eight_directions_or_none(descriptors, value, direction):
    axes, _ = decoder_of(descriptors["joystick"]).decode((value << 20).to_bytes(7, "little"))
    assert axes[2:4] == direction


def test_a_device_whose_reports_are_always_short_has_the_controls_in_them(descriptors):
    decoder = decoder_of(descriptors["joystick"])
    axes, held = decoded(decoder, [0xFF, 0xFF, 0xFF, 255])
    assert axes["Rz"] == axes["X"] == 1.0
    assert isnan(axes["Slider"])
    assert held == set()
    assert decoder.fault is None
    assert decoder.ignored == Ignored(short=1)


def test_a_long_report_is_no_harm(descriptors):
    decoder = decoder_of(descriptors["joystick"])
    axes, _ = decoded(decoder, [0] * 7 + [255] * 60)
    assert axes["Slider"] == -1.0
    axes, _ = decoded(decoder, [0] * 7)
    assert axes["Slider"] == -1.0
    assert decoder.ignored == Ignored(long=1)


@pytest.mark.parametrize(
    ("report", "fault", "count"),
    [
        ([1, 255, 255], "report of 2 bytes after reports of 4", Ignored(short=1)),
        ([1], "report of 0 bytes after reports of 4", Ignored(short=1)),
        ([7, 255, 255, 255, 255], "report of type 7, which", Ignored(undeclared=1)),
        ([], "report of type 0, which", Ignored(undeclared=1)),
    ],
)
def test_after_a_shorter_or_undeclared_report_nothing_is_deflected_or_held(report, fault, count):
    descriptor = (
        "05 01 09 04 A1 01 85 01 15 00 26 FF 00 75 08 95 03 09 30 09 31 09 32 81 02"
        "05 09 19 01 29 08 25 01 75 01 95 08 81 02 85 02 05 01 26 FF 00 75 08 95 01 09 33 81 02 C0"
    )
    decoder = decoder_of(bytes.fromhex(descriptor))
    decoded(decoder, [2, 255])
    assert decoded(decoder, [1, 255, 0, 0, 1])[1] == {"Button 1"}
    axes, held = decoded(decoder, report)
    assert all(map(isnan, axes.values()))
    assert held == set()
    assert fault in decoder.fault
    assert decoder.ignored == count
    axes, held = decoded(decoder, [1, 255, 255, 255, 2])
    assert decoder.fault is None
    assert (axes["X"], held) == (1.0, {"Button 2"})
    assert isnan(axes["Rx"])  # said before the fault


def test_a_value_beyond_its_range_is_nowhere_but_one_count_is_the_end():
    plain = "05 01 09 04 A1 01 09 30 15 01 25 0A 75 08 95 01 81 02 C0"
    decoder = decoder_of(bytes.fromhex(plain))
    assert decoded(decoder, [0])[0] == {"X": -1.0}
    assert decoded(decoder, [11])[0] == {"X": 1.0}
    assert isnan(decoded(decoder, [200])[0]["X"])
    assert decoder.ignored == Ignored(beyond=1)
    with_null = decoder_of(bytes.fromhex(plain.replace("81 02", "81 42")))
    assert decoded(with_null, [10])[0] == {"X": 1.0}
    assert isnan(decoded(with_null, [0])[0]["X"])
    assert with_null.ignored == Ignored()


def test_a_pressure_is_held_from_the_middle_on():
    decoder = decoder_of(
        bytes.fromhex("05 01 09 05 A1 01 05 09 09 01 15 00 26 FF 00 75 08 95 01 81 02 C0")
    )
    assert [decoder.decode(bytes([value]))[1] for value in (0, 127, 128, 255)] == [
        (False,),
        (False,),
        (True,),
        (True,),
    ]


def test_the_last_usage_is_that_of_all_that_are_left():
    descriptor = "05 01 09 04 A1 01 09 30 09 31 15 00 25 7F 75 08 95 04 81 02 C0"
    assert decoder_of(bytes.fromhex(descriptor)).axes == ("X", "Y", "Y 2", "Y 3")


def test_what_does_not_change_or_has_no_range_or_number_is_no_control():
    head, axis = "05 01 09 04 A1 01 75 08 95 01 15 00 25 7F", "09 30 81 02"
    constant, no_range = "09 31 81 03", "25 00 09 32 81 02 25 7F"
    button_0 = "05 09 19 00 29 02 75 01 95 03 81 02"
    decoder = decoder_of(bytes.fromhex(f"{head} {constant} {axis} {no_range} {button_0} C0"))
    assert decoder.axes == ("X",)
    assert decoder.buttons == ("Button 1", "Button 2")
    assert decoder.decode(bytes([9, 127, 9, 0b101])) == ((1.0,), (False, True))


def test_a_hat_from_1_to_8_is_at_rest_at_0(descriptors):
    axes, _ = decoder_of(descriptors["triggers"]).decode(bytes([1, *[0] * 16]))
    assert axes[-2:] == (0.0, 0.0)


def test_turned_notches_are_no_deflection():
    axes = "05 01 09 08 A1 01 15 81 25 7F 75 08 95 01 09 37 81 06 09 38 81 02 C0"
    assert decoder_of(bytes.fromhex(axes)).axes == ("Wheel",)


def test_two_of_the_same_usage_are_two_axes_but_one_in_two_reports_is_one():
    head, axis = "05 01 09 04 A1 01 15 00 26 FF 00 75 08", "09 36 95 01 81 02"
    twice = decoder_of(bytes.fromhex(f"{head} {axis} {axis} C0"))
    assert twice.axes == ("Slider", "Slider 2")
    assert twice.decode(bytes([0, 255]))[0] == (-1.0, 1.0)
    either = decoder_of(bytes.fromhex(f"{head} 85 01 {axis} 85 02 {axis} C0"))
    assert either.axes == ("Slider",)
    assert either.decode(bytes([2, 255]))[0] == (1.0,)
    assert either.decode(bytes([1, 0]))[0] == (-1.0,)


def test_a_usage_before_its_page_and_one_with_a_page_of_its_own():
    before = bytes.fromhex("05 01 09 04 A1 01 05 00 09 30 05 01 0B BB 00 02 00") + bytes.fromhex(
        "15 00 26 FF 00 75 08 95 02 81 02 C0"
    )
    assert decoder_of(before).axes == ("X", "Throttle")


@pytest.mark.parametrize(
    ("descriptor", "reason"),
    [
        ("05 01 09 06 A1 01 09 30 15 00 25 7F 75 08 95 01 81 02 C0", "no axis and no button"),
        ("", "no axis and no button"),
        ("05 01 09 04 A1 01 26 FF", "truncated: byte 6 of 8"),
        ("05 01 09 04 B4", "byte 4: Pop without a Push"),
        ("05 01 C0", "byte 2: a collection ends that has not begun"),
        ("85 00", "a report of number 0: must be 1 to 255"),
        ("09 30 75 08 97 FF FF FF FF 81 02", "4294967295 more fields of 8 bits"),
        ("09 30 77 FF FF FF FF 95 01 81 02", "1 more fields of 4294967295 bits"),
        ("09 30 75 01 96 FF 0F 81 02 95 02 81 02", "byte 11: 2 more fields of 1 bits"),
    ],
)
def test_a_descriptor_that_is_of_no_use_says_why(descriptor, reason):
    with pytest.raises(DescriptorError, match=reason):
        decoder_of(bytes.fromhex(descriptor))


def test_a_long_item_is_skipped():
    descriptor = "05 01 09 04 A1 01 FE 02 10 AA BB 09 30 15 00 25 7F 75 08 95 01 81 02 C0"
    assert decoder_of(bytes.fromhex(descriptor)).axes == ("X",)


@pytest.mark.parametrize("name", ["joystick", "triggers"])
def test_fields_sit_where_hid_parser_finds_them(descriptors, name):
    # These two have neither lists nor repeated usages, where it counts wrongly.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", hid_parser.HIDWarning)
        theirs = hid_parser.ReportDescriptor(descriptors[name])
    number = theirs.input_report_ids[0]
    ours = [
        (field.offset, field.size, field.usages[0])
        for field in ReportDescriptor.parse(descriptors[name]).fields
    ]
    assert ours == [
        (int(item.offset), int(item.size), int(item.usage))
        for item in theirs.get_input_items(number)
        if isinstance(item, hid_parser.VariableItem) and not item.constant
    ]
