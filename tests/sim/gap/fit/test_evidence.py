"""Evidence: what records of unknown memory leave, and what of it goes to another process."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.fit.evidence import beside, within_a_row

sys.path.insert(0, str(Path(__file__).parents[1]))  # no test module: the records
from short_records import LATE, evidence

PARALLEL = np.outer(1e8 * np.sin(np.linspace(0.0, 9.0, 2000)), [1.0, 1.0])


def test_memories_that_are_parallel_and_huge_are_nuisances_all_the_same():
    """Normal equations of such columns are singular to the last digit."""
    gap = PARALLEL[:, 0] * 1e-8 + np.cos(np.linspace(0.0, 40.0, 2000))
    left = beside(list(PARALLEL.T), gap)
    along = PARALLEL[:, 0] / np.linalg.norm(PARALLEL[:, 0])
    expected = gap - along * (along @ gap)
    assert np.max(np.abs(left - expected)) < 1e-3


def test_a_memory_is_taken_in_amounts_of_about_one():
    memory = np.full(4, 0.5)
    left = beside([memory], 3.0 * memory)
    assert left == pytest.approx(1.5 * memory)  # mᵀm = 1: half of what would take all away


def test_evidence_is_sent_without_its_caches_and_listeners():
    seen = replace(evidence(LATE), heartbeat=lambda: None)
    residual = seen.residual()
    assert seen._runs
    make, figures = seen.__reduce__()
    sent = make(*figures)
    assert sent.heartbeat is not seen.heartbeat
    assert not sent._runs
    np.testing.assert_allclose(sent.residual(), residual)


def centred(signal):
    return signal - signal.mean()


@pytest.mark.parametrize("rows", [-1.0, -0.4, 0.0, 0.7, 1.0])
def test_when_within_its_row_an_output_was_read_is_no_gap(rows):
    output = np.cumsum(np.sin(np.linspace(0.0, 40.0, 2000)))
    real = np.interp(np.arange(2000) + rows, np.arange(2000), output)
    left = within_a_row(centred(real - output), output, centred)
    assert np.abs(left).max() < 0.01 * np.abs(np.diff(output)).max()


def test_an_output_that_is_late_by_rows_is_a_gap_all_the_same():
    output = np.cumsum(np.sin(np.linspace(0.0, 40.0, 2000)))
    gap = centred(np.interp(np.arange(2000) - 5, np.arange(2000), output) - output)
    left = within_a_row(gap, output, centred)
    assert np.linalg.norm(left) == pytest.approx(0.8 * np.linalg.norm(gap), rel=0.01)
