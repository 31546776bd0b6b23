"""A capture is assembled from frames while the estimate of its board's clock changes."""

from types import SimpleNamespace

import numpy as np

from rotemina.drivers.mc68hc11.capturing import BoardCapture
from rotemina.drivers.mc68hc11.protocol import BoardState, CaptureSamples


class SingleAxis(list):
    """One axis whose steps are its values."""

    def __init__(self):
        super().__init__([SimpleNamespace(name="zn", number=0, to_si=float)])


def test_sample_times_increase_when_the_clock_estimate_improves():
    board = SimpleNamespace(axes=SingleAxis(), latest_us=0, latest=None, state=BoardState.CAPTURING)
    shifts_s = iter((0.0, 5e-5, -3e-3))
    run = BoardCapture(board, ["zn"], 1000, 6, 40, lambda time_us: 1e-6 * time_us + next(shifts_s))
    run.note_acceptance(0)
    board.latest_us = 10_000
    run.check_telemetry()
    portions = []
    for begin in (0, 2, 4):
        run.receive(CaptureSamples(begin, np.array([begin, begin + 1], dtype=">u2").tobytes()))
        portions.append(run.take())
    assert portions[-1].complete
    time_s = np.concatenate([part.device_time_s for part in portions])
    np.testing.assert_allclose(1e3 * time_s, [10, 11, 12.05, 13.05, 13.55, 14.55])
