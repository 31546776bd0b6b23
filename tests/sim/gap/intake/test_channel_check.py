"""Axes that do not follow their command."""

import sys
from pathlib import Path

import numpy as np

from rotemina.sim.records import Tap

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from intake_records import get_refusal, modify_record, simulate_record


def test_an_axis_that_does_not_respond_is_refused():
    record = simulate_record()
    floating = 3e-5 + 1e-6 * np.random.default_rng(0).standard_normal(4000)
    unresponsive = modify_record(record, {("zn", Tap.REF): None, ("zn", Tap.MEAS): floating})
    message = get_refusal(unresponsive, names=["a.csv"])
    assert message.startswith("a.csv: zn.meas does not follow zn.cmd (its gain is ")
    assert message.endswith("switch the axis on, or leave its columns out")


def test_swapped_channels_are_refused():
    record = simulate_record(axes=("thx", "thy"))
    swapped = {
        ("thx", Tap.MEAS): record.signal("thy", Tap.MEAS),
        ("thy", Tap.MEAS): record.signal("thx", Tap.MEAS),
    }
    message = get_refusal(modify_record(record, swapped))
    assert "thx.meas does not follow thx.cmd but thy.cmd (its gain is " in message
    assert "channels may be swapped" in message
