"""The same measurements given twice."""

import sys
from pathlib import Path

import numpy as np

from rotemina.sim.gap.intake import check_records
from rotemina.sim.simulation import simulate

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from intake_records import ROBOT, get_refusal, make_commands, modify_record, simulate_record


def test_the_same_measurements_twice_are_refused():
    record = simulate_record()
    copy = modify_record(record, {}, name="another")
    message = get_refusal(record, simulate_record(seed=1), copy, names=["a.csv", "b.csv", "c.csv"])
    assert message.startswith("c.csv: it contains the same measurements as a.csv (")
    for piece in (record.select_rows(slice(1000, 3000)), record.select_rows(slice(2500, None))):
        assert "the same measurements" in get_refusal(record, piece)
        assert "the same measurements" in get_refusal(piece, record)
    overlapping = record.select_rows(slice(0, 2500)), record.select_rows(slice(2000, None))
    assert "the same measurements" in get_refusal(*overlapping)


def test_repeated_runs_and_rests_are_not_copies():
    assert check_records(ROBOT, [simulate_record(seed=1), simulate_record(seed=2)]) == ()
    commands_at_rest = make_commands(("x",), share=0.0)
    rests = [simulate(ROBOT, (), commands_at_rest, np.random.default_rng(seed)) for seed in (1, 2)]
    assert {str(caution.text)[:27] for caution in check_records(ROBOT, rests)} == {
        "The axis was never commande"
    }
    record = simulate_record()
    assert (
        check_records(
            ROBOT, [record.select_rows(slice(0, 2000)), record.select_rows(slice(2000, None))]
        )
        == ()
    )
