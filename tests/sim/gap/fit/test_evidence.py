"""Evidence: residuals of records with unknown memory, and transfer to another process."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotemina.sim.gap.fit.evidence import beside, within_a_row

# The shared records are in a module of the parent folder.
sys.path.insert(0, str(Path(__file__).parents[1]))
from short_records import DELAY, make_evidence

PARALLEL = np.outer(1e8 * np.sin(np.linspace(0.0, 9.0, 2000)), [1.0, 1.0])


def test_huge_parallel_memories_are_removed():
    """The normal equations of such columns are numerically singular."""
    gap = PARALLEL[:, 0] * 1e-8 + np.cos(np.linspace(0.0, 40.0, 2000))
    residual = beside(list(PARALLEL.T), gap)
    direction = PARALLEL[:, 0] / np.linalg.norm(PARALLEL[:, 0])
    expected = gap - direction * (direction @ gap)
    assert np.max(np.abs(residual - expected)) < 1e-3


def test_a_memory_is_removed_with_a_coefficient_of_about_one():
    memory = np.full(4, 0.5)
    residual = beside([memory], 3.0 * memory)
    # mᵀm = 1, therefore half of the coefficient that would remove everything.
    assert residual == pytest.approx(1.5 * memory)


def test_evidence_is_sent_without_its_caches_and_listeners():
    evidence = replace(make_evidence(DELAY), heartbeat=lambda: None)
    residual = evidence.residual()
    assert evidence._runs
    make, arguments = evidence.__reduce__()
    received = make(*arguments)
    assert received.heartbeat is not evidence.heartbeat
    assert not received._runs
    np.testing.assert_allclose(received.residual(), residual)


def centre(signal):
    return signal - signal.mean()


@pytest.mark.parametrize("rows", [-1.0, 0.7])
def test_a_shift_of_less_than_a_row_is_not_a_gap(rows):
    output = np.cumsum(np.sin(np.linspace(0.0, 40.0, 2000)))
    real = np.interp(np.arange(2000) + rows, np.arange(2000), output)
    residual = within_a_row(centre(real - output), output, centre)
    assert np.abs(residual).max() < 0.01 * np.abs(np.diff(output)).max()


def test_a_delay_of_several_rows_is_a_gap():
    output = np.cumsum(np.sin(np.linspace(0.0, 40.0, 2000)))
    gap = centre(np.interp(np.arange(2000) - 5, np.arange(2000), output) - output)
    residual = within_a_row(gap, output, centre)
    assert np.linalg.norm(residual) == pytest.approx(0.8 * np.linalg.norm(gap), rel=0.01)
