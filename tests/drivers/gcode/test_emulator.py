"""The emulated controller, byte for byte, as GRBL 1.1 answers."""

import pytest

from rotemina.drivers.gcode.emulator import EmulatedStage
from rotemina.sim.robot.file import load_robot


@pytest.fixture
def stage():
    made = EmulatedStage(load_robot("xyz"))
    assert made.advance(0.01) == b"\r\nGrbl 1.1h ['$' for help]\r\n[MSG:'$H'|'$X' to unlock]\r\n"
    return made


class Host:
    def __init__(self, stage):
        self.stage, self.now_s = stage, 0.01

    def said(self, data, seconds=0.02):
        self.stage.receive(data, self.now_s)
        self.now_s += seconds
        return self.stage.advance(self.now_s).decode()


@pytest.fixture
def host(stage):
    return Host(stage)


@pytest.fixture
def unlocked(host):
    assert host.said(b"$X\n") == "[MSG:Caution: Unlocked]\r\nok\r\n"
    return host


@pytest.mark.parametrize(
    ("said", "answered"),
    [
        (b"?", "<Alarm|MPos:0.000,0.000,0.000|FS:0,0>\r\n"),
        (b"G0 X-1\n", "error:9\r\n"),
        (b"$J=X-1 F100\n", "error:9\r\n"),
        (b"$I\n", "[VER:1.1h.20190830:]\r\n[OPT:VH,15,128]\r\n[MACHINE:virtual]\r\nok\r\n"),
    ],
)
def test_locked_it_tells_and_moves_nothing(host, said, answered):
    assert host.said(said) == answered


@pytest.mark.parametrize(
    ("said", "answered"),
    [
        (b"$J=X-1\n", "error:22\r\n"),
        (b"$J=F100\n", "error:26\r\n"),
        (b"$J=X1 F100\n", "error:15\r\n"),
        (b"$J=M3 F100\n", "error:16\r\n"),
        (b"G2 X-1\n", "error:20\r\n"),
        (b"M3\n", "error:20\r\n"),
        (b"G1 X-1\n", "error:22\r\n"),
        (b"X-\n", "error:2\r\n"),
        (b"$nonsense\n", "error:3\r\n"),
        (b"\n", "ok\r\n"),
    ],
)
def test_what_makes_no_sense_is_refused_by_its_number(unlocked, said, answered):
    assert unlocked.said(said) == answered


def test_a_held_program_goes_on_when_it_is_resumed(unlocked):
    assert unlocked.said(b"G1 X-10 F600\nG1 X-11\n", 0.5) == "ok\r\nok\r\n"
    assert unlocked.said(b"!", 0.005) == ""
    assert unlocked.said(b"?").startswith("<Hold:1|")
    unlocked.said(b"", 0.2)
    assert unlocked.said(b"?").startswith("<Hold:0|")
    held = unlocked.stage.count
    unlocked.said(b"", 1.0)
    assert unlocked.stage.count == held
    unlocked.said(b"~", 3.0)
    assert unlocked.said(b"?") == "<Idle|MPos:-11.000,0.000,0.000|FS:0,0>\r\n"


def test_a_held_program_is_gone_after_a_reset(unlocked):
    unlocked.said(b"G1 X-10 F600\nG1 X-11\n", 0.5)
    unlocked.said(b"!G1 X-12\n", 0.5)
    assert unlocked.said(b"\x18") == "\r\nGrbl 1.1h ['$' for help]\r\n"
    held = unlocked.stage.count
    unlocked.said(b"~", 2.0)
    assert unlocked.stage.count == held


def test_a_reset_in_motion_loses_the_position(unlocked):
    unlocked.said(b"G0 X-10\n", 0.5)
    assert unlocked.said(b"\x18").startswith("ALARM:3\r\n")
    assert "unlock" in unlocked.said(b"\x18")


def test_a_jog_is_cancelled_and_its_queue_forgotten(unlocked):
    assert unlocked.said(b"$J=X-10 F600\n$J=X-20 F600\n", 0.3) == "ok\r\nok\r\n"
    unlocked.said(b"\x85", 0.2)
    assert unlocked.said(b"?").startswith("<Idle|")
    assert -5.0 < unlocked.stage.count[0] < -2.0


def test_a_target_beyond_the_travel_is_a_soft_limit(unlocked):
    assert unlocked.said(b"G0 X1\n").startswith("ALARM:2\r\n[MSG:Reset to continue]\r\n")
    assert unlocked.said(b"?$X\n") == ""
    assert "unlock" in unlocked.said(b"\x18")


def test_homing_is_silent_until_its_end_and_a_reset_ends_it(host):
    assert host.said(b"$HZ\n", 1.0) == ""
    assert host.said(b"?", 3.0).startswith("ok\r\n<Idle|MPos:0.000,0.000,-29.000|")
    assert host.said(b"$HX\n", 1.0) == ""
    assert host.said(b"\x18").startswith("ALARM:6\r\n")


def test_more_bytes_than_it_has_room_for_are_lost(unlocked):
    unlocked.said(b"G1 X-1 F60\n", 0.1)
    unlocked.said(b"!", 0.1)  # held, it takes no line
    unlocked.said(b"; " * 200)
    unlocked.said(b"~", 2.0)
    assert len(unlocked.stage._rx) == 128


def test_inches_and_increments(unlocked):
    unlocked.said(b"G20 G91\nG0 X-1\nG0 X-0.5\n", 6.0)
    assert unlocked.stage.count[0] == pytest.approx(-38.1)
