"""Operator's side of a session: devices, teleoperation, penetration and recorder on one loop."""

import threading
from dataclasses import replace

import pytest

from rotemina.app.errors import PenetrationError, RequestRefusedError
from rotemina.app.motion.inputs import OperatorAction
from rotemina.app.motion.penetration import PenetrationParameters
from rotemina.app.motion.recording import Recording, find_unfinished
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import PlaybackFinished
from rotemina.app.motion.teleoperation import CoordinateScale, ModeScales
from rotemina.app.operation import OperatorControl
from rotemina.app.operation.operation import PENETRATION_FILE, SCALES_FILE
from rotemina.drivers.contract import DeviceState, VirtualClock
from rotemina.drivers.inputs import InputIdentity, InputPad
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot

TICK_S = 0.005


class OperationBench:
    """An operation on the simulator that the test steps."""

    def __init__(self, folder, robot="rotemina"):
        self.clock = VirtualClock(5.0)
        self.messages = []
        self.session = MotionSession(Simulator(load_robot(robot), clock=self.clock))
        self.session.connect()
        self.session.run_once()
        actions = (
            OperatorAction.STOP,
            OperatorAction.PENETRATION,
            OperatorAction.TOOL,
            OperatorAction.RECENTRE,
        )
        self.stick = InputPad("stick", buttons=actions, clock=self.clock)
        self.stick.identity = InputIdentity("hid:stick", "stick", "hid")
        self.operation = OperatorControl(
            self.session,
            folder / "config",
            folder / "data",
            sources={"stick": self.stick},
            clock=self.clock,
            notify=self.messages.append,
        )
        self.operation.devices.detect_changes()

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
def make_bench(tmp_path):
    """Return a function that starts the operator's side again with the same folders."""
    benches = []

    def make():
        benches.append(OperationBench(tmp_path))
        return benches[-1]

    yield make
    for bench in benches:
        bench.operation.close()
        bench.session.close()


@pytest.fixture
def bench(make_bench):
    return make_bench()


def test_unplugging_the_stick_during_a_move_stops_it(bench):
    bench.run(0.3)
    bench.stick.deflect("x", 1.0)
    bench.run(0.3)
    bench.stick.unplug()
    bench.run(0.2)
    assert bench.session.stop_requested_s is not None
    assert bench.session.snapshot().activity is DeviceState.IDLE


def test_the_tool_is_switched_by_its_button(bench):
    bench.run(0.3)
    assert bench.session.tool.is_on is False
    bench.press(OperatorAction.TOOL)
    assert bench.session.tool.is_on is True
    bench.press(OperatorAction.TOOL)
    assert bench.session.tool.is_on is False


def test_recentring_brings_zn_to_mid_range_and_the_tip_stays(bench):
    bench.session.go_to({"zn": 20e-6})
    tip = bench.run(1.0).tip
    bench.press(OperatorAction.RECENTRE)
    bench.operation._planning_thread.join()
    state = bench.run(4.0)
    assert state.command["zn"] == pytest.approx(32.5e-6, abs=2e-7)
    assert state.tip[2] == pytest.approx(tip[2], abs=2e-7)
    assert bench.messages == []


def test_preparing_makes_room_for_a_penetration_and_the_tip_stays(bench):
    parameters = PenetrationParameters()
    tip = bench.run(0.1).tip
    with pytest.raises(PenetrationError, match=r"32.5 µm of travel left"):
        bench.operation.arm_penetration(parameters)
    bench.run(0.1)
    playback_ends = []
    bench.session.subscribe(
        lambda event: isinstance(event, PlaybackFinished) and playback_ends.append(event)
    )
    bench.operation.prepare_penetration(parameters)
    bench.operation._planning_thread.join()
    assert bench.messages == []
    state = bench.run(4.0)
    assert state.command["zn"] > 62e-6
    assert state.tip[2] == pytest.approx(tip[2], abs=2e-7)
    assert [event.shown for event in playback_ends] == [False]  # it is not a run for the comparison
    bench.operation.arm_penetration(parameters)
    with pytest.raises(PenetrationError, match="the whole range is 65 µm"):
        bench.operation.prepare_penetration(replace(parameters, depth=7e-5))
    with pytest.raises(PenetrationError, match="only zn can be moved back"):
        bench.operation.prepare_penetration(replace(parameters, axis="z"))


def test_recentring_during_a_move_is_refused(bench):
    bench.session.go_to({"x": 0.03})
    bench.run(0.1)
    with pytest.raises(RequestRefusedError, match="still moving"):
        bench.operation.recentre()


def test_the_session_is_recorded(bench, tmp_path):
    path = bench.operation.start_recording({"why": "test"})
    with pytest.raises(RequestRefusedError, match="running"):
        bench.operation.start_recording()
    bench.run(0.3)
    bench.stick.deflect("x", 1.0)
    bench.run(0.5)
    bench.stick.release_all()
    bench.run(0.5)
    assert bench.operation.stop_recording() == path
    with pytest.raises(RequestRefusedError, match="nothing"):
        bench.operation.stop_recording()
    recording = Recording.open(path)
    assert "intent" in recording.channels
    assert "input hid:stick" in recording.channels
    x = recording.read_samples().command[:, 0]
    assert x[-1] > x[0]


def test_scales_are_saved_and_a_bad_file_is_reported(make_bench, tmp_path):
    scales = ModeScales().with_scale("micro", "x", CoordinateScale(way=1e-3, speed=2e-3))
    make_bench().operation.use_scales(scales)
    assert make_bench().operation.teleoperator.scales == scales
    (tmp_path / "config" / SCALES_FILE).write_text("modes = 3", "utf-8")
    operation = make_bench().operation
    assert SCALES_FILE in operation.problems[0]
    assert operation.teleoperator.scales == ModeScales()


def test_penetration_parameters_are_saved_and_a_bad_file_is_reported_at_the_start(
    make_bench, tmp_path
):
    operation = make_bench().operation
    assert operation.penetration_parameters == PenetrationParameters()
    parameters = PenetrationParameters(depth=2e-5, shape="table", table=((0.0, 0.0), (1.0, 1.0)))
    operation.save_penetration_parameters(parameters)
    assert make_bench().operation.penetration_parameters == parameters
    (tmp_path / "config" / PENETRATION_FILE).write_text("depth = 3", "utf-8")
    bench = make_bench()
    assert bench.operation.penetration_parameters == PenetrationParameters()
    assert bench.messages == []  # no window could show it yet
    bench.operation.start()
    bench.operation.close()
    assert "depth = 3 m: must be 1 µm to 100 µm; presets are used" in bench.messages[0]


def test_its_threads_end(tmp_path):
    bench = OperationBench(tmp_path)
    bench.operation.start()
    bench.operation.start_recording()
    bench.operation.close()
    names = {thread.name for thread in threading.enumerate()}
    assert not names & {"operation", "input devices", "recorder", "recorder sync", "re-centring"}
    assert not find_unfinished(bench.operation.recordings)
