"""Inverses in a session over the boards' own protocol, in virtual time."""

import numpy as np
import pytest

from rotemina.app.motion.compensation import NamedInverse
from rotemina.app.motion.session import MotionSession
from rotemina.app.motion.state import CommandRefused, Faulted
from rotemina.sim.compensate.held_setpoint_inverse import HeldInverse
from rotemina.sim.compensate.inverse_parameters import InverseModel

pytestmark = pytest.mark.slow
STEP = 1e-9  # m, of zn's set-points


def test_jogs_and_speeds_of_boards_go_through_it(joined_bench, robot):
    bench, seen, events = joined_bench(robot), [], []
    session, zn = MotionSession(bench.driver), robot.axes["zn"]
    column = tuple(robot.axes).index("zn")
    session.tap(lambda samples, _: seen.append(samples))
    session.subscribe(events.append)

    def run(seconds):
        for _ in range(round(seconds / 1e-3)):
            bench.clock.advance(1e-3)
            session.run_once()

    def at():
        """Return what is wanted of zn, and what was sent, m."""
        return session.snapshot().command["zn"], seen[-1].inputs[-1, column] * zn.gain

    model = InverseModel(
        axis="zn",
        unit="m",
        kind="prandtl_ishlinskii",
        sample_s=1e-3,
        origin=0.0,
        command_origin=0.0,
        span=zn.span,
        desired_range=(2e-6, 60e-6),
        command_range=zn.range,
        speed=1.0,
        consequents=np.array([[0.0, 0.9, 0.1]]),
        radii=np.array([0.1]),
        initial=np.zeros(1),
    )
    session.connect()
    run(0.6)
    before = session.snapshot().command["zn"]
    session.inverses.apply(NamedInverse(model, robot.name, "PI"))
    run(0.1)
    assert set(session.inverses.applied) == {"zn"}
    own = HeldInverse(model, before)
    for act, target in (
        (lambda: session.go_to({"zn": 45e-6}), 45e-6),
        (lambda: session.jog("zn", -5e-6), 40e-6),
    ):
        act()
        run(0.6)
        wanted, sent = at()
        assert wanted == pytest.approx(target, abs=STEP)
        assert sent == pytest.approx(own.aim(target), abs=STEP)
        own.follow(np.array([sent]))
    session.move_velocity({"zn": -2e-5}, 0.15)
    run(0.5)
    wanted, sent = at()
    assert 36.8e-6 < wanted < 37.5e-6  # 0.15 s at no more than was wanted
    assert own.follow(np.array([sent]))[-1] == pytest.approx(wanted, abs=5 * STEP)
    assert not [event for event in events if isinstance(event, CommandRefused | Faulted)]
