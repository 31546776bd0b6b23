"""The descriptor alone says how a report becomes deflections and buttons."""

import warnings
from math import isnan

import hid_parser
import pytest

from rotemina.drivers.contract import DescriptorError
from rotemina.drivers.inputs.hid_decoder import HidDecoder, IgnoredCounts
from rotemina.drivers.inputs.hid_descriptor import ReportDescriptor


def make_decoder(descriptor):
    return HidDecoder(ReportDescriptor.parse(descriptor))


def decode_report(decoder, report):
    axes, buttons = decoder.decode(bytes(report))
    pressed = {
        name for name, is_pressed in zip(decoder.buttons, buttons, strict=True) if is_pressed
    }
    return dict(zip(decoder.axes, axes, strict=True)), pressed


def test_a_classic_joystick(descriptors):
    decoder = make_decoder(descriptors["joystick"])
    assert decoder.axes == ("X", "Y", "Hat right", "Hat towards", "Rz", "Slider")
    assert decoder.buttons == tuple(f"Button {number}" for number in range(1, 13))
    # x 1023, y 0, hat 2 (right), twist 255, buttons 1 and 8, throttle 0, button 12
    report = 1023 | 0 << 10 | 2 << 20 | 255 << 24 | 0x81 << 32 | 0 << 40 | 8 << 48
    axes, pressed = decode_report(decoder, report.to_bytes(7, "little"))
    assert tuple(axes.values()) == (1.0, -1.0, 1.0, 0.0, 1.0, -1.0)
    assert pressed == {"Button 1", "Button 8", "Button 12"}


def test_a_gamepad_with_vendor_defined_bits(descriptors):
    decoder = make_decoder(descriptors["gamepad"])
    assert decoder.axes == ("X", "Y", "Z", "Rz", "Hat right", "Hat towards", "Rx", "Ry")
    assert len(decoder.buttons) == 14
    report = [1, 255, 0, 0, 255, 0x18, 0, 0x02 | 0x3F << 2, 51, 255, *[0xA5] * 54]
    axes, pressed = decode_report(decoder, report)
    assert [axes[name] for name in ("X", "Y", "Z", "Rz", "Ry")] == [1.0, -1.0, -1.0, 1.0, 1.0]
    assert axes["Rx"] == pytest.approx(2 * 51 / 255 - 1, abs=1e-15)
    # The vendor-defined bits are not decoded.
    assert pressed == {"Button 1", "Button 14"}
    # The hat's value 8 is its null state.
    assert (axes["Hat right"], axes["Hat towards"]) == (0.0, 0.0)


def test_triggers_on_the_simulation_page(descriptors):
    decoder = make_decoder(descriptors["triggers"])
    assert decoder.axes == (
        *("X", "Y", "Z", "Rz", "Brake", "Accelerator", "Hat right", "Hat towards"),
    )
    report = [1, 0, 0, 255, 255, 0, 128, 0, 0, 255, 3, 0, 0, 8, 0x02, 0x40, 1]
    axes, pressed = decode_report(decoder, report)
    assert [axes[name] for name in ("X", "Y", "Brake", "Accelerator")] == [-1.0, 1.0, 1.0, -1.0]
    assert axes["Z"] == pytest.approx(0.0, abs=2 / 65535)
    # The hat counts from 1 to 8, and 8 is up left.
    assert (axes["Hat right"], axes["Hat towards"]) == (-1.0, -1.0)
    assert pressed == {"Button 2", "Button 15"}


def test_six_axes_in_two_reports(descriptors):
    decoder = make_decoder(descriptors["six axes"])
    assert decoder.axes == ("X", "Y", "Z", "Rx", "Ry", "Rz")
    axes, _ = decode_report(decoder, [1, 0x5E, 0x01, 0xA2, 0xFE, 0, 0])
    assert [axes[name] for name in "XYZ"] == [1.0, -1.0, 0.0]
    # An axis without a report so far is unknown, not centred.
    assert all(isnan(axes[name]) for name in ("Rx", "Ry", "Rz"))
    axes, _ = decode_report(decoder, [2, 0, 0, 0, 0, 0xAF, 0x00])
    assert list(axes.values()) == [1.0, -1.0, 0.0, 0.0, 0.0, 0.5]
    axes, pressed = decode_report(decoder, [3, 2, 0])
    assert pressed == {"Button 2"}
    assert list(axes.values()) == [1.0, -1.0, 0.0, 0.0, 0.0, 0.5]


def test_a_list_of_buttons_and_odd_encodings(descriptors):
    decoder = make_decoder(descriptors["list"])
    assert decoder.axes == ("X", "Y", "Slider")
    assert decoder.buttons == tuple(f"Button {number}" for number in range(1, 11))
    axes, pressed = decode_report(decoder, [1, 0xA3, 0x00, 0x81, 0x7F, 255])
    assert pressed == {"Button 3", "Button 10"}
    assert axes == {"X": -1.0, "Y": 1.0, "Slider": 1.0}
    axes, pressed = decode_report(decoder, [1, 0x03, 0x00, 0x80, 0, 0])
    # A button that is no longer listed is released.
    assert pressed == {"Button 3"}
    # X reports -128, one less than its declared minimum.
    assert axes == {"X": -1.0, "Y": 0.0, "Slider": -1.0}
    # Report 2 belongs to the keyboard.
    assert decoder.decode(bytes([2, 255])) is None
    assert decoder.ignored == IgnoredCounts(unknown=1)


def test_a_hat_points_in_eight_directions_or_none(descriptors):
    decoder = make_decoder(descriptors["joystick"])
    directions = [(0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1)]
    for value, direction in enumerate([*directions, *[(0, 0)] * 8]):
        axes, _ = decoder.decode((value << 20).to_bytes(7, "little"))
        assert axes[2:4] == direction


def test_a_device_with_short_reports_has_the_controls_in_them(descriptors):
    decoder = make_decoder(descriptors["joystick"])
    axes, pressed = decode_report(decoder, [0xFF, 0xFF, 0xFF, 255])
    assert axes["Rz"] == axes["X"] == 1.0
    assert isnan(axes["Slider"])
    assert pressed == set()
    assert decoder.fault is None
    assert decoder.ignored == IgnoredCounts(short=1)


def test_extra_bytes_of_a_report_are_ignored(descriptors):
    decoder = make_decoder(descriptors["joystick"])
    axes, _ = decode_report(decoder, [0] * 7 + [255] * 60)
    assert axes["Slider"] == -1.0
    axes, _ = decode_report(decoder, [0] * 7)
    assert axes["Slider"] == -1.0
    assert decoder.ignored == IgnoredCounts(long=1)


@pytest.mark.parametrize(
    ("report", "fault", "count"),
    [
        ([1, 255, 255], "report of 2 bytes after reports of 4", IgnoredCounts(short=1)),
        ([1], "report of 0 bytes after reports of 4", IgnoredCounts(short=1)),
        ([7, 255, 255, 255, 255], "report of the undeclared type 7,", IgnoredCounts(undeclared=1)),
        ([], "report of the undeclared type 0,", IgnoredCounts(undeclared=1)),
    ],
)
def test_a_shorter_or_undeclared_report_releases_all_controls(report, fault, count):
    descriptor = (
        "05 01 09 04 A1 01 85 01 15 00 26 FF 00 75 08 95 03 09 30 09 31 09 32 81 02"
        "05 09 19 01 29 08 25 01 75 01 95 08 81 02 85 02 05 01 26 FF 00 75 08 95 01 09 33 81 02 C0"
    )
    decoder = make_decoder(bytes.fromhex(descriptor))
    decode_report(decoder, [2, 255])
    assert decode_report(decoder, [1, 255, 0, 0, 1])[1] == {"Button 1"}
    axes, pressed = decode_report(decoder, report)
    assert all(map(isnan, axes.values()))
    assert pressed == set()
    assert fault in decoder.fault
    assert decoder.ignored == count
    axes, pressed = decode_report(decoder, [1, 255, 255, 255, 2])
    assert decoder.fault is None
    assert (axes["X"], pressed) == (1.0, {"Button 2"})
    # The value from before the fault is not used any more.
    assert isnan(axes["Rx"])


def test_a_value_beyond_its_range_is_unknown_except_by_one_count():
    descriptor = "05 01 09 04 A1 01 09 30 15 01 25 0A 75 08 95 01 81 02 C0"
    decoder = make_decoder(bytes.fromhex(descriptor))
    assert decode_report(decoder, [0])[0] == {"X": -1.0}
    assert decode_report(decoder, [11])[0] == {"X": 1.0}
    assert isnan(decode_report(decoder, [200])[0]["X"])
    assert decoder.ignored == IgnoredCounts(beyond=1)
    decoder_with_null_state = make_decoder(bytes.fromhex(descriptor.replace("81 02", "81 42")))
    assert decode_report(decoder_with_null_state, [10])[0] == {"X": 1.0}
    assert isnan(decode_report(decoder_with_null_state, [0])[0]["X"])
    assert decoder_with_null_state.ignored == IgnoredCounts()


def test_an_analog_button_is_pressed_from_half_its_range():
    descriptor = "05 01 09 05 A1 01 05 09 09 01 15 00 26 FF 00 75 08 95 01 81 02 C0"
    decoder = make_decoder(bytes.fromhex(descriptor))
    states = [decoder.decode(bytes([value]))[1] for value in (0, 127, 128, 255)]
    assert states == [(False,), (False,), (True,), (True,)]


def test_the_last_usage_applies_to_all_remaining_fields():
    descriptor = "05 01 09 04 A1 01 09 30 09 31 15 00 25 7F 75 08 95 04 81 02 C0"
    assert make_decoder(bytes.fromhex(descriptor)).axes == ("X", "Y", "Y 2", "Y 3")


def test_constants_and_fields_without_range_or_number_are_no_controls():
    head, axis = "05 01 09 04 A1 01 75 08 95 01 15 00 25 7F", "09 30 81 02"
    constant, no_range = "09 31 81 03", "25 00 09 32 81 02 25 7F"
    button_0 = "05 09 19 00 29 02 75 01 95 03 81 02"
    decoder = make_decoder(bytes.fromhex(f"{head} {constant} {axis} {no_range} {button_0} C0"))
    assert decoder.axes == ("X",)
    assert decoder.buttons == ("Button 1", "Button 2")
    assert decoder.decode(bytes([9, 127, 9, 0b101])) == ((1.0,), (False, True))


def test_a_hat_from_1_to_8_is_at_rest_at_0(descriptors):
    axes, _ = make_decoder(descriptors["triggers"]).decode(bytes([1, *[0] * 16]))
    assert axes[-2:] == (0.0, 0.0)


def test_a_relative_wheel_is_no_axis():
    axes = "05 01 09 08 A1 01 15 81 25 7F 75 08 95 01 09 37 81 06 09 38 81 02 C0"
    assert make_decoder(bytes.fromhex(axes)).axes == ("Wheel",)


def test_a_repeated_usage_is_a_second_axis_but_not_in_another_report():
    head, axis = "05 01 09 04 A1 01 15 00 26 FF 00 75 08", "09 36 95 01 81 02"
    decoder = make_decoder(bytes.fromhex(f"{head} {axis} {axis} C0"))
    assert decoder.axes == ("Slider", "Slider 2")
    assert decoder.decode(bytes([0, 255]))[0] == (-1.0, 1.0)
    decoder_of_two_reports = make_decoder(bytes.fromhex(f"{head} 85 01 {axis} 85 02 {axis} C0"))
    assert decoder_of_two_reports.axes == ("Slider",)
    assert decoder_of_two_reports.decode(bytes([2, 255]))[0] == (1.0,)
    assert decoder_of_two_reports.decode(bytes([1, 0]))[0] == (-1.0,)


def test_a_usage_may_precede_its_page_or_contain_one():
    descriptor = bytes.fromhex(
        "05 01 09 04 A1 01 05 00 09 30 05 01 0B BB 00 02 00"
    ) + bytes.fromhex("15 00 26 FF 00 75 08 95 02 81 02 C0")
    assert make_decoder(descriptor).axes == ("X", "Throttle")


def test_an_unusable_descriptor_is_refused_with_the_reason():
    for descriptor, reason in {
        "05 01 09 06 A1 01 09 30 15 00 25 7F 75 08 95 01 81 02 C0": "no axis and no button",
        "": "no axis and no button",
        "05 01 09 04 A1 01 26 FF": "truncated: the item at byte 6 of 8",
        "05 01 09 04 B4": "byte 4: Pop without a Push",
        "05 01 C0": "byte 2: a collection ends that has not begun",
        "85 00": "report number 0: must be 1 to 255",
        "09 30 75 08 97 FF FF FF FF 81 02": "4294967295 more fields of 8 bits",
        "09 30 77 FF FF FF FF 95 01 81 02": "1 more fields of 4294967295 bits",
        "09 30 75 01 96 FF 0F 81 02 95 02 81 02": "byte 11: 2 more fields of 1 bits",
    }.items():
        with pytest.raises(DescriptorError, match=reason):
            make_decoder(bytes.fromhex(descriptor))


def test_a_long_item_is_skipped():
    descriptor = "05 01 09 04 A1 01 FE 02 10 AA BB 09 30 15 00 25 7F 75 08 95 01 81 02 C0"
    assert make_decoder(bytes.fromhex(descriptor)).axes == ("X",)


@pytest.mark.parametrize("name", ["joystick", "triggers"])
def test_fields_have_the_same_offsets_as_in_hid_parser(descriptors, name):
    # These two have no lists and no repeated usages, for which hid_parser counts wrongly.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", hid_parser.HIDWarning)
        reference = hid_parser.ReportDescriptor(descriptors[name])
    number = reference.input_report_ids[0]
    fields = [
        (field.offset, field.size, field.usages[0])
        for field in ReportDescriptor.parse(descriptors[name]).fields
    ]
    assert fields == [
        (int(item.offset), int(item.size), int(item.usage))
        for item in reference.get_input_items(number)
        if isinstance(item, hid_parser.VariableItem) and not item.constant
    ]
