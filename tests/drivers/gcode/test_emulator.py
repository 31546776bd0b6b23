"""The emulated controller answers like GRBL 1.1, byte for byte."""

import pytest

from rotemina.drivers.gcode import EmulatedStage
from rotemina.sim.robot_files import load_robot


@pytest.fixture
def stage():
    stage = EmulatedStage(load_robot("xyz"))
    assert stage.advance(0.01) == b"\r\nGrbl 1.1h ['$' for help]\r\n[MSG:'$H'|'$X' to unlock]\r\n"
    return stage


class Host:
    def __init__(self, stage):
        self.stage, self.now_s = stage, 0.01

    def exchange(self, data, seconds=0.02):
        self.stage.receive(data, self.now_s)
        self.now_s += seconds
        return self.stage.advance(self.now_s).decode()


@pytest.fixture
def host(stage):
    return Host(stage)


@pytest.fixture
def unlocked_host(host):
    assert host.exchange(b"$X\n") == "[MSG:Caution: Unlocked]\r\nok\r\n"
    return host


def test_a_locked_controller_reports_but_moves_nothing(host):
    replies = {
        b"?": "<Alarm|MPos:0.000,0.000,0.000|FS:0,0>\r\n",
        b"G0 X-1\n": "error:9\r\n",
        b"$J=X-1 F100\n": "error:9\r\n",
        b"$I\n": "[VER:1.1h.20190830:]\r\n[OPT:VH,15,128]\r\n[MACHINE:virtual]\r\nok\r\n",
    }
    assert {line: host.exchange(line) for line in replies} == replies


def test_an_invalid_line_is_rejected_with_its_error_number(unlocked_host):
    replies = {
        b"$J=X-1\n": "error:22\r\n",
        b"$J=F100\n": "error:26\r\n",
        b"$J=X1 F100\n": "error:15\r\n",
        b"$J=M3 F100\n": "error:16\r\n",
        b"G2 X-1\n": "error:20\r\n",
        b"M3\n": "error:20\r\n",
        b"G1 X-1\n": "error:22\r\n",
        b"X-\n": "error:2\r\n",
        b"$nonsense\n": "error:3\r\n",
        b"\n": "ok\r\n",
    }
    assert {line: unlocked_host.exchange(line) for line in replies} == replies


def test_a_held_program_continues_after_a_resume(unlocked_host):
    assert unlocked_host.exchange(b"G1 X-10 F600\nG1 X-11\n", 0.5) == "ok\r\nok\r\n"
    assert unlocked_host.exchange(b"!", 0.005) == ""
    assert unlocked_host.exchange(b"?").startswith("<Hold:1|")
    unlocked_host.exchange(b"", 0.2)
    assert unlocked_host.exchange(b"?").startswith("<Hold:0|")
    held_counts = unlocked_host.stage.count
    unlocked_host.exchange(b"", 1.0)
    assert unlocked_host.stage.count == held_counts
    unlocked_host.exchange(b"~", 3.0)
    assert unlocked_host.exchange(b"?") == "<Idle|MPos:-11.000,0.000,0.000|FS:0,0>\r\n"


def test_a_reset_drops_a_held_program(unlocked_host):
    unlocked_host.exchange(b"G1 X-10 F600\nG1 X-11\n", 0.5)
    unlocked_host.exchange(b"!G1 X-12\n", 0.5)
    assert unlocked_host.exchange(b"\x18") == "\r\nGrbl 1.1h ['$' for help]\r\n"
    held_counts = unlocked_host.stage.count
    unlocked_host.exchange(b"~", 2.0)
    assert unlocked_host.stage.count == held_counts


def test_a_reset_during_motion_loses_the_position(unlocked_host):
    unlocked_host.exchange(b"G0 X-10\n", 0.5)
    assert unlocked_host.exchange(b"\x18").startswith("ALARM:3\r\n")
    assert "unlock" in unlocked_host.exchange(b"\x18")


def test_cancelling_a_jog_clears_its_queue(unlocked_host):
    assert unlocked_host.exchange(b"$J=X-10 F600\n$J=X-20 F600\n", 0.3) == "ok\r\nok\r\n"
    unlocked_host.exchange(b"\x85", 0.2)
    assert unlocked_host.exchange(b"?").startswith("<Idle|")
    assert -5.0 < unlocked_host.stage.count[0] < -2.0


def test_a_target_beyond_the_travel_is_a_soft_limit(unlocked_host):
    assert unlocked_host.exchange(b"G0 X1\n").startswith("ALARM:2\r\n[MSG:Reset to continue]\r\n")
    assert unlocked_host.exchange(b"?$X\n") == ""
    assert "unlock" in unlocked_host.exchange(b"\x18")


def test_homing_is_silent_until_its_end_and_a_reset_aborts_it(host):
    assert host.exchange(b"$HZ\n", 1.0) == ""
    assert host.exchange(b"?", 3.0).startswith("ok\r\n<Idle|MPos:0.000,0.000,-29.000|")
    assert host.exchange(b"$HX\n", 1.0) == ""
    assert host.exchange(b"\x18").startswith("ALARM:6\r\n")


def test_bytes_beyond_the_receive_buffer_are_lost(unlocked_host):
    unlocked_host.exchange(b"G1 X-1 F60\n", 0.1)
    # A held controller executes no line.
    unlocked_host.exchange(b"!", 0.1)
    unlocked_host.exchange(b"; " * 200)
    unlocked_host.exchange(b"~", 2.0)
    assert len(unlocked_host.stage._rx) == 128


def test_inches_and_relative_positions_are_understood(unlocked_host):
    unlocked_host.exchange(b"G20 G91\nG0 X-1\nG0 X-0.5\n", 6.0)
    assert unlocked_host.stage.count[0] == pytest.approx(-38.1)
