"""Guided calibrations on the simulated microscope: the hidden mounting is found, or none is."""

from dataclasses import replace
from datetime import UTC, datetime
from itertools import cycle

import numpy as np
import pytest

from rotemina.app.microscope.calibration_file import MICRO, NANO
from rotemina.app.microscope.calibration_run import Phase
from rotemina.app.motion.mailbox import RefusedError
from rotemina.drivers.cameras.frame import Region
from rotemina.sim.robot.model import AxisEffect
from rotemina.sim.trajectory.axis_limits import OutOfLimitsError


@pytest.mark.parametrize("stage", [MICRO, pytest.param(NANO, marks=pytest.mark.slow)])
def test_the_hidden_mounting_is_found_and_the_stage_goes_back(bench, stage):
    before = dict(bench.session.snapshot().command)
    status = bench.run(bench.begin(stage, today=lambda: datetime(2026, 11, 21, tzinfo=UTC)))
    assert status.phase is Phase.DONE, status.reason
    found, truth = status.fit.map.geometry, bench.true_map().geometry
    for size, true_size in zip(found.pixel_size, truth.pixel_size, strict=True):
        assert size == pytest.approx(true_size, rel=1e-3)
    assert np.degrees(abs(found.rotation - truth.rotation)) < 0.05
    assert np.degrees(abs(found.skew - truth.skew)) < 0.1
    assert found.handedness == truth.handedness == -1
    assert status.fit.residual_rms < 0.2
    assert status.calibration.date == "2026-11-21T00:00:00+00:00"
    assert bench.session.snapshot().command == pytest.approx(before, abs=1e-9)
    assert status.calibration.tip_px == pytest.approx(bench.true_pixel(), abs=0.3)


def test_a_stop_ends_it_where_it_is(bench):
    run = bench.begin()
    while run.status.done < 2:
        bench.step()
        run.step(bench.clock())
    bench.session.stop()
    bench.step()
    assert run.step(bench.clock()).phase is Phase.FAILED
    assert "stopped" in run.status.reason
    place = dict(bench.session.snapshot().command)
    for _ in range(20):
        bench.step()
        run.step(bench.clock())
    assert bench.session.snapshot().command == place


def test_it_can_be_given_up(bench):
    run = bench.begin()
    while run.status.done < 2:
        bench.step()
        run.step(bench.clock())
    run.abort()
    assert run.status.phase is Phase.FAILED
    assert bench.session.stop_asked_s is not None


class Spoilt:
    """What a camera may do to its frames."""

    @staticmethod
    def frozen(bench):
        still = bench.frame
        return lambda frame: replace(frame, pixels=still.pixels)

    @staticmethod
    def cycling(bench):
        """Give the pictures that were seen before the latest move, one after the other."""
        buffers = cycle(bench.seen[-3:])
        return lambda frame: replace(frame, pixels=next(buffers))

    @staticmethod
    def stalled(bench):
        still = bench.frame
        return lambda _: still

    @staticmethod
    def black(bench):
        return lambda frame: replace(frame, pixels=np.clip(frame.pixels, 0, 45))

    @staticmethod
    def smaller(bench):
        def cut(frame):
            region = Region(0, 0, 400, 300)
            return replace(frame, pixels=frame.pixels[:300, :400], region=region)

        return cut

    @staticmethod
    def empty(bench):
        rng = np.random.default_rng(0)

        def noise(frame):
            pixels = rng.normal(2000.0, 30.0, frame.pixels.shape).astype(np.uint16)
            return replace(frame, pixels=pixels)

        return noise


@pytest.mark.parametrize(
    ("how", "told"),
    [
        (Spoilt.frozen, "frozen"),
        (Spoilt.cycling, "frozen"),
        (Spoilt.stalled, "stalled"),
        (Spoilt.black, "black"),
        (Spoilt.smaller, "400 × 300 px"),
        (Spoilt.empty, "nothing in the picture matches it"),
    ],
)
def test_a_picture_that_cannot_be_trusted_ends_it_without_further_moves(bench, how, told):
    run = bench.begin()
    bench.seen = []
    while run.status.done < 1:
        bench.step()
        bench.seen.append(bench.frame.pixels)
        run.step(bench.clock())
    bench.spoil = how(bench)
    status = bench.run(run)
    assert status.phase is Phase.FAILED
    assert told in status.reason
    assert status.calibration is None


def test_a_featureless_picture_is_refused_before_anything_moves(bench):
    bench.spoil = Spoilt.empty(bench)
    bench.step()
    before = dict(bench.session.snapshot().command)
    status = bench.run(bench.begin())
    assert status.phase is Phase.FAILED
    assert "nothing in the picture matches it" in status.reason
    assert bench.session.snapshot().command == before


def test_a_tip_that_gets_lost_sends_the_stage_back_to_where_it_began(bench):
    before = dict(bench.session.snapshot().command)
    run = bench.begin()
    while run.status.done < 2:
        bench.step()
        run.step(bench.clock())
    bench.spoil = Spoilt.empty(bench)
    status = bench.run(run)
    assert status.phase is Phase.FAILED
    assert bench.session.snapshot().command == pytest.approx(before, abs=1e-9)


def test_a_background_that_stands_is_no_moving_stage(bench):
    status = bench.run(bench.begin(pipette=False))
    assert status.phase is Phase.FAILED
    assert "registration" in status.reason or "calibration" in status.reason


@pytest.mark.slow
def test_backlash_that_the_sensors_do_not_see_is_refused(make_bench):
    slack = [AxisEffect(axis=axis, id="backlash", parameters={"width": 4e-6}) for axis in "xy"]
    bench = make_bench(effects=slack)
    status = bench.run(bench.begin())
    assert status.phase is Phase.FAILED
    assert "drifted by" in status.reason
    assert status.calibration is None


def test_a_place_at_the_end_of_the_range_is_refused_at_once(bench):
    bench.session.go_to({"x": 10e-6})
    bench.rest()
    with pytest.raises(OutOfLimitsError, match="axis x"):
        bench.begin()


def test_locked_motion_is_refused_at_once(bench):
    bench.session.bar("a replay is shown")
    with pytest.raises(RefusedError, match="replay"):
        bench.begin()
