"""The two buttons at the machine, without a profile: start and stop a penetration, change mode."""

import pytest

from rotemina.app.motion.operation import Operation
from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.session import MotionSession
from rotemina.drivers.clock import VirtualClock
from rotemina.drivers.simulator.driver import Simulator
from rotemina.sim.robot.file import load_robot

MIDDLE = (0.5, 0.5, 0.5)
START_STOP, MODE = (True, False), (False, True)


class Desk:
    """An operation whose only device are the potentiometers and buttons at the machine."""

    def __init__(self, folder):
        self.clock = VirtualClock(5.0)
        self.told = []
        self.driver = Simulator(load_robot("rotemina"), clock=self.clock)
        self.driver.set_analog_inputs(MIDDLE, (False, False))
        self.session = MotionSession(self.driver)
        self.session.connect()
        self.session.run_once()
        self.operation = Operation(
            self.session, folder, folder, clock=self.clock, told=self.told.append
        )
        self.operation.devices.look()

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
def desk(tmp_path):
    made = Desk(tmp_path)
    yield made
    made.operation.close()
    made.session.close()


def test_the_first_starts_an_armed_penetration_and_ends_it(desk):
    desk.run(0.3)
    desk.press(START_STOP)
    assert "not armed" in desk.told[0]
    assert desk.phase == "disarmed"
    desk.session.go_to({"zn": 60e-6})
    desk.run(1.0)
    desk.operation.arm_penetration(PenetrationParameters(depth=2e-5))
    desk.press(START_STOP)
    assert desk.phase == "approach"
    desk.press(START_STOP)
    desk.run(2.0)
    assert desk.phase == "aborted"


def test_the_second_goes_on_to_the_next_mode(desk):
    desk.run(0.3)
    assert desk.operation.teleoperator.state.mode == "micro"
    desk.press(MODE)
    assert desk.operation.teleoperator.state.mode == "nano"
