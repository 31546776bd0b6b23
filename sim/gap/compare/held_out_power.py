"""Remainders of hypotheses on unseen data: held-out power by channel and block.

The channels are the drive, the true motion, and the sensor's deviation from it. Reading and true
motion share everything else that the machine does; comparing each separately would count that
twice.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.records import Tap

BLOCKS = 32  # into which the rows of a channel are cut
MOST_COUNTED = 100.0  # independent rows, as which any number of rows counts at most


class Power(NamedTuple):
    """Held-out power of hypotheses in one channel.

    ``squares`` (hypotheses, blocks) are sums over the rows of each block, over the floor;
    ``rows`` (blocks,) counts these; ``counted`` is how many independent rows the channel is
    worth: ``1/n_c = 1/n_eff + 1/100``.
    """

    squares: FloatArray
    rows: FloatArray
    counted: float


def held_out_powers(evidence: Evidence, left: Sequence[FloatArray]) -> list[Power]:
    """Return the power, channel by channel, of the remainder of each hypothesis.

    Parameters
    ----------
    evidence : Evidence
    left : sequence of (rows,)
        What each leaves of data that its fit did not see, over the floor.
    """
    least = min(range(len(left)), key=lambda number: float(np.mean(left[number] ** 2)))
    by_hypothesis = [_channels(evidence, one) for one in left]
    powers = []
    for channel, best in by_hypothesis[least].items():
        independent = sum(effective_rows(run) for run in best)
        cut = [_blocked(one[channel]) for one in by_hypothesis]
        powers.append(
            Power(
                np.array([squares for squares, _ in cut]),
                cut[0][1],
                1.0 / (1.0 / independent + 1.0 / MOST_COUNTED),
            )
        )
    return powers


def effective_rows(run: FloatArray) -> float:
    """Return how many independent rows a run (n,) is worth for its power: n/τ.

    ``τ = 1 + 2 Σ r_k²`` with the autocorrelation r (Bartlett, J. R. Statist. Soc. B 8 (1946) 27-41,
    of a variance), over lags up to half the run.
    """
    rows = len(run)
    centred = run - run.mean()
    spectrum = np.fft.rfft(centred, 2 * rows)
    covariance = np.fft.irfft(spectrum * np.conj(spectrum))[: max(rows // 2, 1)]
    if covariance[0] <= 0.0:
        return float(rows)
    correlation = covariance[1:] / covariance[0]
    return rows / (1.0 + 2.0 * float(correlation @ correlation))


def _channels(evidence: Evidence, left: FloatArray) -> dict[Tap, list[FloatArray]]:
    """Return the remainder in each channel, one (n,) per record that has it."""
    by_record: dict[int, dict[Tap, FloatArray]] = {}
    for part in evidence.parts:
        by_record.setdefault(part.record, {})[part.tap] = left[part.rows]
    found: dict[Tap, list[FloatArray]] = {}
    for number, taps in by_record.items():
        floor = evidence.observations[number].floor
        for tap, own in taps.items():
            beyond = own
            if tap is Tap.MEAS and Tap.REF in taps:
                apart = own * floor[Tap.MEAS] - taps[Tap.REF] * floor[Tap.REF]
                beyond = apart / np.hypot(floor[Tap.MEAS], floor[Tap.REF])
            found.setdefault(tap, []).append(beyond)
    return found


def _blocked(runs: Sequence[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Return sums of squares (blocks,) and rows (blocks,) of contiguous blocks of all runs."""
    rows = sum(len(run) for run in runs)
    pieces = [
        piece
        for run in runs
        for piece in np.array_split(run, min(max(round(BLOCKS * len(run) / rows), 1), len(run)))
    ]
    squares = np.array([float(piece @ piece) for piece in pieces])
    return squares, np.array([float(len(piece)) for piece in pieces])
