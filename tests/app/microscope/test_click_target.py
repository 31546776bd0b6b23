"""Clicks: the acceptance of the microscope, what is refused, and sequences of targets."""

import numpy as np
import pytest

from rotemina.app.microscope.calibration_file import MICRO, NANO
from rotemina.app.microscope.click_corrections import ClickRun, Visit
from rotemina.app.microscope.click_target import ClickToMove
from rotemina.app.microscope.errors import MicroscopeError
from rotemina.app.microscope.targets import TargetSequence
from rotemina.app.motion.mailbox import RefusedError
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError


def visit(bench, clicks, pixel, **options):
    move = clicks.plan(np.asarray(pixel), frame=bench.frame, **options)
    return ClickRun(
        clicks,
        bench.newest,
        move,
        bench.track(),
        now_s=bench.clock(),
        before=bench.image(),
        confirmed=True,
    )


def test_calibrate_click_and_the_true_tip_lands_within_half_a_pixel(bench):
    clicks = ClickToMove(bench.session, bench.calibrated(MICRO, NANO))
    for pixel in ((250.4, 200.7), (430.0, 330.2), bench.beside(12.3, -7.9), (500, 100)):
        status = bench.run(visit(bench, clicks, pixel))
        assert status.visit is Visit.ARRIVED, status.reason
        assert np.linalg.norm(bench.true_pixel() - pixel) < 0.5


def test_a_worn_piezo_is_corrected_until_the_tip_is_there(make_bench):
    bench = make_bench(
        effects=[
            AxisEffect(axis=axis, id="hysteresis", parameters={"width": 0.12 * 1.16e-3})
            for axis in ("thx", "thy")
        ]
    )
    clicks = ClickToMove(bench.session, bench.known())
    pixel = bench.beside(40.0, 25.0)
    status = bench.run(visit(bench, clicks, pixel, stage=NANO))
    assert status.visit is Visit.ARRIVED, status.reason
    assert status.corrections >= 1
    assert np.linalg.norm(bench.true_pixel() - pixel) < 0.5


@pytest.fixture
def clicks(bench):
    return ClickToMove(bench.session, bench.known())


def test_a_near_click_is_the_nano_stage_and_a_far_one_the_tables(bench, clicks):
    assert clicks.plan(bench.beside(30.0, 0.0)).stage == NANO
    far = clicks.plan(np.array([600.0, 480.0]))
    assert far.stage == MICRO
    assert set(far.targets) == {"x", "y"}
    with pytest.raises(OutOfLimitsError, match="axis th"):
        clicks.plan(np.array([600.0, 480.0]), stage=NANO)


def test_the_ghost_is_where_the_tip_will_be_and_nothing_moves(bench, clicks):
    before = dict(bench.session.snapshot().command)
    move = clicks.plan(np.array([400.0, 300.0]))
    assert move.ghost == pytest.approx([400.0, 300.0], abs=0.05)
    bench.step(5)
    assert bench.session.snapshot().command == before
    clicks.go(move)
    bench.step(60)
    assert bench.true_pixel() == pytest.approx(move.ghost, abs=0.5)


def test_a_large_move_wants_to_be_confirmed(bench, clicks):
    clicks.confirm_m = 20e-6
    move = clicks.plan(bench.beside(100.0, 0.0))
    assert move.confirm
    with pytest.raises(MicroscopeError, match="confirm"):
        clicks.go(move)
    clicks.go(move, confirmed=True)


def test_undo_returns_to_where_the_tip_was(bench, clicks):
    begin = bench.true_pixel()
    clicks.go(clicks.plan(bench.beside(30.0, 20.0)))
    bench.step(40)
    assert np.linalg.norm(bench.true_pixel() - begin) > 30.0
    clicks.session.undo()
    bench.step(60)
    assert bench.true_pixel() == pytest.approx(begin, abs=0.3)


@pytest.mark.parametrize("pixel", [(-5.0, 100.0), (700.0, 100.0), (100.0, 520.0), (np.nan, 1.0)])
def test_a_click_outside_the_calibrated_field_is_refused(clicks, pixel):
    with pytest.raises(MicroscopeError, match="outside the calibrated field"):
        clicks.plan(np.array(pixel))


def test_a_click_without_calibration_is_refused(bench):
    with pytest.raises(MicroscopeError, match="not calibrated"):
        ClickToMove(bench.session, None).plan(np.array([10.0, 10.0]))
    with pytest.raises(MicroscopeError, match="micro stage is not calibrated"):
        ClickToMove(bench.session, bench.empty()).plan(np.array([10.0, 10.0]))


def test_a_click_in_a_picture_of_another_resolution_is_refused(make_bench, clicks):
    other = make_bench({"width": 400, "height": 300})
    with pytest.raises(MicroscopeError, match="400 × 300 px"):
        clicks.plan(np.array([10.0, 10.0]), frame=other.frame)


def test_the_keep_out_and_locks_hold_for_clicks(bench, clicks):
    move = clicks.plan(np.array([300.0, 250.0]))
    height = bench.session.bounds.teach_floor()
    bench.session.bounds._guard.teach_floor(height + 1e-6)
    with pytest.raises(OutOfLimitsError, match="floor"):
        clicks.go(move)
    bench.session.bounds.clear_floor()
    bench.session.bar("somebody works at the dish")
    with pytest.raises(RefusedError, match="works at the dish"):
        clicks.go(move)


def test_a_tip_that_is_not_where_it_should_be_moves_nothing_more(bench, clicks):
    run = visit(bench, clicks, [400.0, 300.0])
    bench.camera.move_focus(400e-6)
    status = bench.run(run)
    assert status.visit is Visit.FAILED
    assert status.corrections == 0


def test_targets_are_visited_in_their_order(bench, clicks):
    sequence = TargetSequence(lambda pixel: visit(bench, clicks, pixel))
    places = [(300.0, 220.0), (340.0, 260.0)]
    for place in places:
        sequence.mark(np.array(place))
    for place in places:
        target = sequence.next()
        with pytest.raises(MicroscopeError, match="moving to a target"):
            sequence.next()
        for _ in range(200):
            bench.step()
            target = sequence.step(bench.clock())
            if target.visit is Visit.ARRIVED:
                break
        assert (target.column, target.row) == place
        assert bench.true_pixel() == pytest.approx(place, abs=0.5)
    with pytest.raises(MicroscopeError, match="every target"):
        sequence.next()
    sequence.clear()
    assert not sequence.targets
