"""The heat map: bands add up, and a known tone lies in the correct cell."""

import numpy as np
import pytest

from rotemina.sim.gap.location import OperatingRegime
from rotemina.sim.gap.output import GapTrace, make_heatmap
from rotemina.sim.records import Record, Tap

RATE_HZ = 1000.0


def make_trace(command, gap, time_s=None):
    """Return one record whose model follows the command exactly, with a gap in floors."""
    time_s = np.arange(len(command)) / RATE_HZ if time_s is None else time_s
    record = Record.from_signals(
        time_s, {("x", Tap.CMD): command, ("x", Tap.MEAS): command + 1e-6 * gap}, {"x": "m"}
    )
    real = record.signal("x", Tap.MEAS)
    return GapTrace(0, record, "x", Tap.MEAS, real, command, command, 1e-6)


def test_a_tone_while_the_axis_rests_lies_in_one_cell():
    time_s = np.arange(8000) / RATE_HZ
    command = 1e-3 * np.interp(time_s, [0.0, 4.0, 8.0], [0.0, 1.0, 1.0])
    gap = np.where(time_s > 4.0, 20.0 * np.sin(2 * np.pi * 17.0 * time_s), 0.0)
    heatmap = make_heatmap([make_trace(command, gap)])
    band = int(np.searchsorted(heatmap.edges_hz, 17.0)) - 1
    assert (heatmap.edges_hz[band], heatmap.edges_hz[band + 1]) == pytest.approx((10.0, 30.0))
    rest = heatmap.regimes.index(OperatingRegime.REST)
    assert heatmap.share[rest, band] > 0.9
    assert heatmap.floors[rest, band] == pytest.approx(20.0 / np.sqrt(2.0), rel=0.05)
    assert (
        heatmap.share[rest].sum()
        + heatmap.share[heatmap.regimes.index(OperatingRegime.FORWARD)].sum()
        > 0.95
    )


def test_records_of_several_rates_share_one_map():
    slow = make_trace(np.linspace(0, 1e-3, 2000), np.ones(2000), np.arange(2000) / 50.0)
    fast = make_trace(np.linspace(0, 1e-3, 2000), np.ones(2000))
    heatmap = make_heatmap([slow, fast])
    assert heatmap.edges_hz[0] <= 1.0 / 40.0
    assert heatmap.edges_hz[-1] >= 500.0
    assert heatmap.share.shape == (len(heatmap.regimes), len(heatmap.edges_hz) - 1)


def test_an_uneven_record_has_no_map():
    time_s = np.sort(np.random.default_rng(0).uniform(0.0, 1.0, 500))
    assert make_heatmap([make_trace(np.linspace(0, 1e-3, 500), np.ones(500), time_s)]) is None
    assert make_heatmap([]) is None
