"""Inverses in a session with virtual boards, over their protocol and in virtual time."""

import numpy as np
import pytest

from rotemina.app.motion.session import MotionSession, NamedInverse
from rotemina.app.motion.state import CommandRefused, FaultRaised
from rotemina.sim.compensate import InverseModel, SetpointInverse

pytestmark = pytest.mark.slow
ZN_STEP_M = 1e-9


def test_jogs_and_velocities_go_through_the_inverse(make_bench, robot):
    bench, recorded_samples, events = make_bench(robot), [], []
    session, zn = MotionSession(bench.driver), robot.axes["zn"]
    column = tuple(robot.axes).index("zn")
    session.tap(lambda samples, _: recorded_samples.append(samples))
    session.subscribe(events.append)

    def run(seconds):
        for _ in range(round(seconds / 1e-3)):
            bench.clock.advance(1e-3)
            session.run_once()

    def read_zn():
        """Return the desired position of zn and the position that was sent, in m."""
        sent = recorded_samples[-1].inputs[-1, column] * zn.gain
        return session.snapshot().command["zn"], sent

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
    initial_command = session.snapshot().command["zn"]
    session.inverses.apply(NamedInverse(model, robot.name, "PI"))
    run(0.1)
    assert set(session.inverses.applied) == {"zn"}
    expected_inverse = SetpointInverse(model, initial_command)
    for command, target in (
        (lambda: session.go_to({"zn": 45e-6}), 45e-6),
        (lambda: session.jog("zn", -5e-6), 40e-6),
    ):
        command()
        run(0.6)
        desired, sent = read_zn()
        assert desired == pytest.approx(target, abs=ZN_STEP_M)
        assert sent == pytest.approx(expected_inverse.add_setpoint(target), abs=ZN_STEP_M)
        expected_inverse.advance(np.array([sent]))
    session.move_velocity({"zn": -2e-5}, 0.15)
    run(0.5)
    desired, sent = read_zn()
    # The velocity lasts 0.15 s and does not exceed its value.
    assert 36.8e-6 < desired < 37.5e-6
    assert expected_inverse.advance(np.array([sent]))[-1] == pytest.approx(
        desired, abs=5 * ZN_STEP_M
    )
    assert not [event for event in events if isinstance(event, CommandRefused | FaultRaised)]
