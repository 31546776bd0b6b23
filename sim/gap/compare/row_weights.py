"""Weights of rows, by what no explanation takes away around them.

A real machine does more than any explanation holds, and far more of it at some times than at
others. Least squares then follow the worst minute of all records, and what the others show clearly
counts for little. So no block of rows counts by more than the median block leaves: Huber's weights
(Annals of Mathematical Statistics 35 (1964) 73-101), block by block.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rotemina.sim.arrays import FloatArray
from rotemina.sim.gap.compare.held_out_power import BLOCKS
from rotemina.sim.gap.fit import Evidence
from rotemina.sim.gap.limits import MIN_SHARE_TO_NAME
from rotemina.sim.records import Tap


def huber_weighted(evidence: Evidence, left: Sequence[FloatArray]) -> Evidence | None:
    """Return evidence whose rows are weighted by the least that is ``left`` of their block.

    Each of several explanations leaves (rows,), over the floor. None where that is about even. Taps
    that are read in cells keep their weights: what lies beyond a cell is no longer linear in it.
    """
    weights: dict[tuple[int, Tap], FloatArray] = {}
    uneven = False
    for tap in dict.fromkeys(part.tap for part in evidence.parts):
        parts = [part for part in evidence.parts if part.tap is tap]
        if any(tap in evidence.observations[part.record].cell for part in parts):
            continue
        rows = sum(part.rows.stop - part.rows.start for part in parts)
        blocks = [
            block
            for part in parts
            for block in np.array_split(
                np.arange(part.rows.start, part.rows.stop),
                min(
                    max(round(BLOCKS * (part.rows.stop - part.rows.start) / rows), 1),
                    part.rows.stop - part.rows.start,
                ),
            )
        ]
        power = np.array(
            [max(min(float(np.mean(one[block] ** 2)) for one in left), 1.0) for block in blocks]
        )
        share = np.minimum(1.0, np.median(power) / power)
        uneven |= float(power @ (1.0 - share)) > MIN_SHARE_TO_NAME * float(power.sum())
        by_row = np.ones(len(left[0]))
        for block, one in zip(blocks, share, strict=True):
            by_row[block] = np.sqrt(one)
        weights |= {(part.record, tap): by_row[part.rows] for part in parts}
    if not uneven:
        return None
    return evidence.with_observations(
        [
            replace(one, weight={tap: w for (of, tap), w in weights.items() if of == number})
            for number, one in enumerate(evidence.observations)
        ]
    )
