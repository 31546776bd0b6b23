"""The two buttons at the machine without a profile: start or stop a penetration, change mode."""

import pytest

from rotemina.app.motion.penetration import PenetrationParameters
from rotemina.app.motion.session import MotionSession
from rotemina.app.operation import OperatorControl
from rotemina.drivers.contract import VirtualClock
from rotemina.drivers.simulator import Simulator
from rotemina.sim.robot_files import load_robot

MIDDLE = (0.5, 0.5, 0.5)
START_STOP, MODE = (True, False), (False, True)


class ButtonBench:
    """An operation whose only input device is the panel at the machine."""

    def __init__(self, folder):
        self.clock = VirtualClock(5.0)
        self.messages = []
        self.driver = Simulator(load_robot("rotemina"), clock=self.clock)
        self.driver.set_analog_inputs(MIDDLE, (False, False))
        self.session = MotionSession(self.driver)
        self.session.connect()
        self.session.run_once()
        self.operation = OperatorControl(
            self.session, folder, folder, clock=self.clock, notify=self.messages.append
        )
        self.operation.devices.detect_changes()

    def run(self, seconds):
        for _ in range(round(seconds / 0.005)):
            self.clock.advance(0.005)
            self.session.run_once()
            self.operation.step(self.clock())

    def press(self, buttons):
        self.driver.set_analog_inputs(MIDDLE, buttons)
        self.run(0.1)
        self.driver.set_analog_inputs(MIDDLE, (False, False))
        self.run(0.1)

    @property
    def phase(self):
        return str(self.operation.penetration.status.phase)


@pytest.fixture
def bench(tmp_path):
    button_bench = ButtonBench(tmp_path)
    yield button_bench
    button_bench.operation.close()
    button_bench.session.close()


def test_the_first_button_starts_and_ends_an_armed_penetration(bench):
    bench.run(0.3)
    bench.press(START_STOP)
    assert "not armed" in bench.messages[0]
    assert bench.phase == "disarmed"
    bench.session.go_to({"zn": 60e-6})
    bench.run(1.0)
    bench.operation.arm_penetration(PenetrationParameters(depth=2e-5))
    bench.press(START_STOP)
    assert bench.phase == "approach"
    bench.press(START_STOP)
    bench.run(2.0)
    assert bench.phase == "aborted"


def test_the_second_button_selects_the_next_mode(bench):
    bench.run(0.3)
    assert bench.operation.teleoperator.state.mode == "micro"
    bench.press(MODE)
    assert bench.operation.teleoperator.state.mode == "nano"
