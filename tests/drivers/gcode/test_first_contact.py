"""What is said of a controller that cannot be reached, and which settings do not matter."""

import pytest

from rotemina.drivers.errors import DriverError, ProtocolError
from rotemina.drivers.gcode.emulator import EmulatedStage
from rotemina.drivers.gcode.first_contact import explain_contact
from rotemina.drivers.gcode.grbl_reports import read_number


class Old(EmulatedStage):
    """GRBL 0.9."""

    def _report_if_asked(self):
        if self._reported:
            self._reported = False
            self._say("<Idle,MPos:0.000,0.000,0.000,WPos:0.000,0.000,0.000>")


class WrongRate(EmulatedStage):
    def advance(self, to_s):
        return bytes((byte * 37 + 11) & 0xFF for byte in super().advance(to_s))


class Printer(EmulatedStage):
    """Another kind of G-code controller."""

    def _say(self, line):
        super()._say("echo:Unknown command")

    def _report_if_asked(self):
        if self._reported:
            self._reported = False
            self._say("")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"line": {"echo": True}}, "turn off the echo"),
        ({"stage": Old}, "GRBL 0.9 or older"),
        ({"stage": WrongRate}, "the baud rate is wrong"),
        ({"stage": Printer}, r"no report of GRBL .* \('echo:Unknown command'\)"),
    ],
)
def test_what_came_instead_of_an_answer_is_named(joined, options, words):
    bench = joined(**options)
    with pytest.raises(DriverError, match=words):
        bench.driver.open()


@pytest.mark.parametrize(
    ("received", "sent", "words"),
    [
        (b"", b"?", "nothing arrived"),
        (b"\0\0\0", b"?", "nothing arrived"),
        (b"???", b"?????", "nothing else"),
        (b"??<Idle|MPos:0.000|FS:0,0>\r\n", b"????", "also returns what is sent"),
        (b"Grbl 0.9j ['$' for help]\r\n", b"?", "0.9 or older"),
        (bytes(range(128, 256)), b"?", "128 bytes arrived that are no text"),
        (b"login: " + b"x" * 500, b"?", "no report of GRBL"),
    ],
)
def test_an_explanation_fits_what_arrived(received, sent, words):
    explanation = explain_contact(received, sent)
    assert words in explanation
    assert len(explanation) < 300


def test_a_setting_that_is_not_needed_never_matters(joined):
    class Networked(EmulatedStage):
        def _tell_or_set(self, text):
            super()._tell_or_set(text)
            if text == "$":
                for line in ("$300=stage", "$302=10.0.0.7", "$70=", "$401=nan", "$/odd/name=a=b"):
                    self._say(line)

    bench = joined(stage=Networked)
    driver = bench.homed()
    driver.move_to({"x": 0.002})
    bench.rest()
    assert driver.status().fault is None


def test_a_setting_that_is_needed_and_no_number_is_named(joined):
    class Broken(EmulatedStage):
        def _tell_or_set(self, text):
            if text == "$":
                self.settings.pop(110, None)
                self._say("$110=fast")
            super()._tell_or_set(text)

    with pytest.raises(DriverError, match=r"axis x: the controller has no setting \$110"):
        joined(stage=Broken).driver.open()


def test_reports_without_a_machine_position_are_refused_with_the_remedy(joined):
    class Work(EmulatedStage):
        def _say(self, line):
            super()._say(line.replace("MPos", "WPos"))

    with pytest.raises(ProtocolError, match=r"send it \$10=1"):
        joined(stage=Work).driver.open()


@pytest.mark.parametrize(
    ("text", "number"),
    [("10", 10.0), ("10.000 (x, step/mm)", 10.0), ("10.0.0.7", None), ("", None), ("inf", None)],
)
def test_a_setting_is_a_number_or_none(text, number):
    assert read_number(text) == number
