"""Messages about a controller that cannot be reached, and settings that do not matter."""

import pytest

from rotemina.drivers.contract import DriverError, ProtocolError
from rotemina.drivers.gcode import EmulatedStage
from rotemina.drivers.gcode.first_contact import explain_no_answer
from rotemina.drivers.gcode.grbl_reports import parse_number


def test_an_unexpected_answer_is_explained(make_bench):
    with pytest.raises(DriverError, match="turn off the echo"):
        make_bench(line={"echo": True}).driver.open()


@pytest.mark.parametrize(
    ("received", "sent", "message"),
    [
        (b"", b"?", "nothing arrived"),
        (b"\0\0\0", b"?", "nothing arrived"),
        (b"???", b"?????", "only an echo"),
        (b"??<Idle|MPos:0.000|FS:0,0>\r\n", b"????", "also echoes the sent bytes"),
        (b"Grbl 0.9j ['$' for help]\r\n", b"?", "0.9 or older"),
        (b"<Idle,MPos:0.000,0.000,0.000,WPos:0.000,0.000,0.000>\r\n", b"?", "0.9 or older"),
        (bytes(range(128, 256)), b"?", "128 bytes arrived that are not text; the baud rate is"),
        (b"login: " + b"x" * 500, b"?", "not a report of GRBL"),
    ],
)
def test_an_explanation_fits_the_received_bytes(received, sent, message):
    explanation = explain_no_answer(received, sent)
    assert message in explanation
    assert len(explanation) < 300


def test_unneeded_settings_are_ignored(make_bench):
    class NetworkedStage(EmulatedStage):
        def _report_or_set(self, text):
            super()._report_or_set(text)
            if text == "$":
                for line in ("$300=stage", "$302=10.0.0.7", "$70=", "$401=nan", "$/odd/name=a=b"):
                    self._send(line)

    driver = make_bench(stage=NetworkedStage).driver
    driver.open()
    assert driver.status().fault is None


def test_a_needed_setting_that_is_not_a_number_is_reported(make_bench):
    class BrokenStage(EmulatedStage):
        def _report_or_set(self, text):
            if text == "$":
                self.settings.pop(110, None)
                self._send("$110=fast")
            super()._report_or_set(text)

    with pytest.raises(DriverError, match=r"axis x: the controller has no setting \$110"):
        make_bench(stage=BrokenStage).driver.open()


def test_reports_without_a_machine_position_are_refused_with_the_remedy(make_bench):
    class WorkPositionStage(EmulatedStage):
        def _send(self, line):
            super()._send(line.replace("MPos", "WPos"))

    with pytest.raises(ProtocolError, match=r"send it \$10=1"):
        make_bench(stage=WorkPositionStage).driver.open()


def test_a_setting_is_a_number_or_none():
    texts = ("10", "10.000 (x, step/mm)", "10.0.0.7", "", "inf")
    assert [parse_number(text) for text in texts] == [10.0, 10.0, None, None, None]
