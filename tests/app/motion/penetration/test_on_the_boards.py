"""A penetration of the simulated cell on virtual boards at true baud, stepped by a real clock."""

import time
from importlib.resources import files

import pytest

from rotemina.app.motion.penetration.parameters import PenetrationParameters
from rotemina.app.motion.penetration.penetration import Penetration
from rotemina.app.motion.penetration.run_log import Verdict
from rotemina.app.motion.penetration.status import UNDER_WAY
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import Phase
from rotemina.app.motion.ticker import Ticker
from rotemina.drivers.mc68hc11.driver import MC68HC11
from rotemina.sim.robot.file import load_robot
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.robot.writing import with_effects

pytestmark = pytest.mark.slow
CELL = AxisEffect(axis="zn", id="contact", parameters={"place": 58e-6, "stiffness": -0.1})


@pytest.fixture
def ports(tmp_path, board_process):
    nominal = files("rotemina.resources.robots").joinpath("rotemina.toml").read_text("utf-8")
    robot = tmp_path / "cell.toml"
    robot.write_text(with_effects(nominal, [CELL]), "utf-8")
    with board_process(robot) as (ports, _):
        yield ports


def until(condition, limit_s):
    end_s = time.monotonic() + limit_s
    while not condition():
        assert time.monotonic() < end_s
        time.sleep(0.01)


def there(session):
    state = session.snapshot()
    return state.phase is Phase.READY and state.command["zn"] == pytest.approx(64e-6, abs=1e-9)


def attempt(session, penetration):
    """Return what becomes of a run from above the cell."""
    until(lambda: session.snapshot().locked is None, 20.0)
    session.go_to({"zn": 64e-6})
    until(lambda: there(session), 10.0)
    time.sleep(1.0)  # until the vibration of the way there has died away
    penetration.arm(PenetrationParameters(depth_tolerance=0.2), time.monotonic())
    penetration.press(time.monotonic())
    until(lambda: penetration.status.phase not in UNDER_WAY, 20.0)
    run = penetration.status.run
    if run.verdict is Verdict.HELD:
        penetration.disarm()
        until(lambda: not session.snapshot().owners, 2.0)
    return run


def test_the_cell_is_penetrated_and_the_tip_comes_back(ports):
    session = MotionSession(
        MC68HC11(load_robot("rotemina"), {"port": ports[0], "second_port": ports[1]})
    )
    penetration = Penetration(session)
    ticker = Ticker("penetration", 0.005, lambda: penetration.step(time.monotonic()))
    session.start()
    ticker.start()
    try:
        for _ in range(4):
            run = attempt(session, penetration)
            # A busy computer lets a virtual board fall silent, which holds, as it must.
            if run.verdict is not Verdict.HELD or "does not answer" not in run.reason:
                break
        assert run.verdict is Verdict.DONE, run.reason
        # At 200 samples a second one place in 300 is off by more than 0.6 µm, at the 100 that a
        # busy computer leaves, 3 in 100 are; how well a place is found, the detector's tests say.
        assert run.contact == pytest.approx(58e-6, abs=1.5e-6)
        assert run.thrust.depth == pytest.approx(50e-6 / 1.1, rel=0.03)
        assert run.thrust.peak_speed == pytest.approx(run.planned_peak_speed / 1.1, rel=0.1)
        assert there(session)
        until(lambda: not session.snapshot().owners, 2.0)
    finally:
        ticker.close()
        penetration.close()
        session.close()
