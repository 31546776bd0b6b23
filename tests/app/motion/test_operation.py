"""An operator's side of a session: devices, teleoperation, penetration, recorder on one loop."""

import threading
from dataclasses import replace

import pytest

from rotemina.app.motion.mailbox import RefusedError
from rotemina.app.motion.operation import PENETRATION, SCALES, Operation
from rotemina.app.motion.penetration.parameters import PenetrationError, PenetrationParameters
from rotemina.app.motion.recording.recording_reader import Recording
from rotemina.app.motion.recording.recovery import unfinished
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import PlaybackFinished
from rotemina.app.motion.teleoperation.intent import Action
from rotemina.app.motion.teleoperation.scales import Scale, Scales
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.inputs.device import InputIdentity
from rotemina.drivers.inputs.pad import Pad
from rotemina.drivers.samples import DeviceState
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot

TICK_S = 0.005


class Bench:
    """An operation on the simulator, stepped by hand."""

    def __init__(self, folder, robot="rotemina"):
        self.clock = VirtualClock(5.0)
        self.told = []
        self.session = MotionSession(Simulator(load_robot(robot), clock=self.clock))
        self.session.connect()
        self.session.run_once()
        actions = (Action.STOP, Action.PENETRATION, Action.TOOL, Action.RECENTRE)
        self.stick = Pad("stick", buttons=actions, clock=self.clock)
        self.stick.identity = InputIdentity("hid:stick", "stick", "hid")
        self.operation = Operation(
            self.session,
            folder / "config",
            folder / "data",
            sources={"stick": self.stick},
            clock=self.clock,
            told=self.told.append,
        )
        self.operation.devices.look()

    def run(self, seconds):
        for _ in range(max(1, round(seconds / TICK_S))):
            self.clock.advance(TICK_S)
            self.session.run_once()
            self.operation.step(self.clock())
        return self.session.snapshot()

    def press(self, action):
        self.stick.hold(action)
        self.run(0.1)
        self.stick.hold(action, False)
        return self.run(0.1)


@pytest.fixture
def bench(tmp_path):
    bench = Bench(tmp_path)
    yield bench
    bench.operation.close()
    bench.session.close()


def test_a_stick_moves_the_robot_and_released_it_rests(bench):
    start = bench.run(0.3).command["x"]
    bench.stick.deflect("x", 1.0)
    assert bench.run(0.5).command["x"] > start + 1e-4
    bench.stick.release_all()
    rest = bench.run(0.5).command["x"]
    assert bench.run(0.3).command["x"] == rest
    assert bench.told == []


def test_withdrawn_in_mid_move_it_stops(bench):
    bench.run(0.3)
    bench.stick.deflect("x", 1.0)
    bench.run(0.3)
    bench.stick.withdraw()
    bench.run(0.2)
    assert bench.session.stop_asked_s is not None
    assert bench.session.snapshot().activity is DeviceState.IDLE


def test_the_penetration_s_button_says_why_not_and_starts_when_armed(bench):
    bench.run(0.3)
    bench.press(Action.PENETRATION)
    assert "not armed" in bench.told[0]
    bench.session.go_to({"zn": 60e-6})
    bench.run(1.0)
    bench.operation.arm_penetration(PenetrationParameters(depth=2e-5))
    bench.press(Action.PENETRATION)
    assert str(bench.operation.penetration.status.phase) == "approach"
    bench.press(Action.PENETRATION)
    bench.run(2.0)
    assert str(bench.operation.penetration.status.phase) == "aborted"
    assert (bench.operation.data / "penetrations.jsonl").exists()


def test_the_tool_is_switched_by_its_button(bench):
    bench.run(0.3)
    assert bench.session.tool.on is False
    bench.press(Action.TOOL)
    assert bench.session.tool.on is True
    bench.press(Action.TOOL)
    assert bench.session.tool.on is False


def test_recentring_brings_zn_to_mid_range_and_the_tip_stays(bench):
    bench.session.go_to({"zn": 20e-6})
    tip = bench.run(1.0).tip
    bench.press(Action.RECENTRE)
    bench.operation._planning.join()
    state = bench.run(4.0)
    assert state.command["zn"] == pytest.approx(32.5e-6, abs=2e-7)
    assert state.tip[2] == pytest.approx(tip[2], abs=2e-7)
    assert bench.told == []


def test_preparing_makes_room_for_a_penetration_and_the_tip_stays(bench):
    parameters = PenetrationParameters()
    tip = bench.run(0.1).tip
    with pytest.raises(PenetrationError, match=r"32.5 µm of travel left"):
        bench.operation.arm_penetration(parameters)
    bench.run(0.1)
    ends = []
    bench.session.subscribe(lambda one: isinstance(one, PlaybackFinished) and ends.append(one))
    bench.operation.prepare_penetration(parameters)
    bench.operation._planning.join()
    assert bench.told == []
    state = bench.run(4.0)
    assert state.command["zn"] > 62e-6
    assert state.tip[2] == pytest.approx(tip[2], abs=2e-7)
    assert [one.shown for one in ends] == [False]  # it is no run to compare
    bench.operation.arm_penetration(parameters)
    with pytest.raises(PenetrationError, match="the whole range is 65 µm"):
        bench.operation.prepare_penetration(replace(parameters, depth=7e-5))
    with pytest.raises(PenetrationError, match="only zn can be moved back"):
        bench.operation.prepare_penetration(replace(parameters, axis="z"))


def test_recentring_in_mid_move_is_refused(bench):
    bench.session.go_to({"x": 0.03})
    bench.run(0.1)
    with pytest.raises(RefusedError, match="still moving"):
        bench.operation.recentre()


def test_what_is_done_is_recorded(bench, tmp_path):
    path = bench.operation.start_recording({"why": "test"})
    with pytest.raises(RefusedError, match="running"):
        bench.operation.start_recording()
    bench.run(0.3)
    bench.stick.deflect("x", 1.0)
    bench.run(0.5)
    bench.stick.release_all()
    bench.run(0.5)
    assert bench.operation.stop_recording() == path
    with pytest.raises(RefusedError, match="nothing"):
        bench.operation.stop_recording()
    recording = Recording.open(path)
    assert "intent" in recording.channels
    assert "input hid:stick" in recording.channels
    x = recording.samples().command[:, 0]
    assert x[-1] > x[0]


def test_scales_are_kept_and_a_bad_file_is_said(bench, tmp_path):
    bench.run(0.3)
    scales = Scales().with_scale("micro", "x", Scale(way=1e-3, speed=2e-3))
    bench.operation.use_scales(scales)
    other = Bench(tmp_path)
    assert other.operation.teleoperator.scales == scales
    other.operation.close()
    (tmp_path / "config" / SCALES).write_text("modes = 3", "utf-8")
    bad = Bench(tmp_path)
    assert SCALES in bad.operation.problems[0]
    assert bad.operation.teleoperator.scales == Scales()
    bad.operation.close()


def test_parameters_of_the_penetration_are_kept_and_a_bad_file_is_told_at_the_start(tmp_path):
    first = Bench(tmp_path)
    assert first.operation.penetration_parameters == PenetrationParameters()
    asked = PenetrationParameters(depth=2e-5, shape="table", table=((0.0, 0.0), (1.0, 1.0)))
    first.operation.keep_penetration(asked)
    first.operation.close()
    other = Bench(tmp_path)
    assert other.operation.penetration_parameters == asked
    other.operation.close()
    (tmp_path / "config" / PENETRATION).write_text("depth = 3", "utf-8")
    bad = Bench(tmp_path)
    assert bad.operation.penetration_parameters == PenetrationParameters()
    assert bad.told == []  # nobody could read it yet
    bad.operation.start()
    bad.operation.close()
    assert "depth = 3 m: must be 1 µm to 100 µm; presets are used" in bad.told[0]


def test_its_threads_end(tmp_path):
    bench = Bench(tmp_path)
    bench.operation.start()
    bench.operation.start_recording()
    bench.operation.close()
    names = {thread.name for thread in threading.enumerate()}
    assert not names & {"operation", "input devices", "recorder", "recorder sync", "re-centring"}
    assert not unfinished(bench.operation.recordings)
