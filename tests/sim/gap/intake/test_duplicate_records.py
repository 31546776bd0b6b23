"""The same measurements given twice."""

import sys
from pathlib import Path

import numpy as np

from rotemina.sim.gap.intake.record_checks import check
from rotemina.sim.simulation.simulation import simulate

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from intake_records import ROBOT, changed, make_commands, measured, refusal


def test_the_same_measurements_twice_are_refused():
    record = measured()
    copy = changed(record, {}, name="another")
    said = refusal(record, measured(seed=1), copy, names=["a.csv", "b.csv", "c.csv"])
    assert said.startswith("c.csv: it holds measurements of a.csv again (")
    for part in (record.part(slice(1000, 3000)), record.part(slice(2500, None))):
        assert "again" in refusal(record, part)
        assert "again" in refusal(part, record)
    overlapping = record.part(slice(0, 2500)), record.part(slice(2000, None))
    assert "again" in refusal(*overlapping)


def test_other_runs_of_the_same_commands_and_rests_are_no_copies():
    assert check(ROBOT, [measured(seed=1), measured(seed=2)]) == ()
    still = make_commands(("x",), share=0.0)
    rests = [simulate(ROBOT, (), still, np.random.default_rng(seed)) for seed in (1, 2)]
    assert {str(one.text)[:27] for one in check(ROBOT, rests)} == {"The axis was never commande"}
    whole = measured()
    assert check(ROBOT, [whole.part(slice(0, 2000)), whole.part(slice(2000, None))]) == ()
