"""A capture put together from frames, whatever becomes of the estimate of its board's clock."""

from types import SimpleNamespace

import numpy as np

from rotemina.drivers.mc68hc11.board_messages import Captured
from rotemina.drivers.mc68hc11.capturing import Capturing
from rotemina.drivers.mc68hc11.protocol_codes import State


class Axes(list):
    """One axis whose steps are its values."""

    def __init__(self):
        super().__init__([SimpleNamespace(name="zn", number=0, value=float)])


def test_a_better_estimate_of_the_clock_turns_no_sample_back():
    board = SimpleNamespace(axes=Axes(), latest_us=0, latest=None, state=State.CAPTURING)
    shifts_s = iter((0.0, 5e-5, -3e-3))
    run = Capturing(board, ["zn"], 1000, 6, 40, lambda time_us: 1e-6 * time_us + next(shifts_s))
    run.granted(0)
    board.latest_us = 10_000
    run.sampled()
    parts = []
    for begin in (0, 2, 4):
        run.receive(Captured(begin, np.array([begin, begin + 1], dtype=">u2").tobytes()))
        parts.append(run.take())
    assert parts[-1].complete
    time_s = np.concatenate([part.device_time_s for part in parts])
    np.testing.assert_allclose(1e3 * time_s, [10, 11, 12.05, 13.05, 13.55, 14.55])
