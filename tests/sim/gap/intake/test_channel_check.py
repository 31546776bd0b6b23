"""Axes that do not answer their own command."""

import sys
from pathlib import Path

import numpy as np

from rotemina.sim.records.record import Tap

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from intake_records import changed, measured, refusal


def test_an_axis_that_does_not_answer_is_refused():
    record = measured()
    floating = 3e-5 + 1e-6 * np.random.default_rng(0).standard_normal(4000)
    silent = changed(record, {("zn", Tap.REF): None, ("zn", Tap.MEAS): floating})
    said = refusal(silent, names=["a.csv"])
    assert said.startswith("a.csv: zn.meas does not follow zn.cmd (its gain is ")
    assert said.endswith("switch the axis on, or leave its columns out")


def test_channels_that_are_swapped_are_refused():
    record = measured(axes=("thx", "thy"))
    swapped = {
        ("thx", Tap.MEAS): record.signal("thy", Tap.MEAS),
        ("thy", Tap.MEAS): record.signal("thx", Tap.MEAS),
    }
    said = refusal(changed(record, swapped))
    assert "thx.meas does not follow thx.cmd but thy.cmd (its gain is " in said
    assert "channels may be swapped" in said
