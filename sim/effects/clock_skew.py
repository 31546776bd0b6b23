"""Sensor with a clock that runs faster or slower than that of the controller."""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    ClockSkew,
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    Values,
)
from rotemina.sim.effects.identification import FitView, IdentificationHints
from rotemina.sim.effects.kinship import EffectRelations
from rotemina.sim.effects.starts import remove_mean
from rotemina.sim.records import Tap

_PPM = 1e-6
# A fit tries this many skew magnitudes, from 1 ppm to the upper bound.
_TRIED_SKEW_COUNT = 40


def _start_from_best_skew(view: FitView) -> Iterator[Values]:
    """Yield the skew that leaves the smallest remainder.

    The model's response is read at the times of the skewed clock.
    """
    low, high = view.bounds("skew")
    magnitudes = np.geomspace(1.0, high, _TRIED_SKEW_COUNT)
    skews = np.concatenate([-magnitudes[magnitudes <= -low], magnitudes])
    remainders = np.zeros(len(skews))
    for record, response in zip(view.records, view.answers, strict=True):
        if Tap.MEAS not in response:
            continue
        time_s = record.time_s
        for index, skew in enumerate(skews):
            skewed_s = time_s - (time_s - time_s[0]) * _PPM * skew
            remainder = remove_mean(
                record.real[Tap.MEAS] - np.interp(skewed_s, time_s, response[Tap.MEAS])
            )
            remainders[index] += float(remainder @ remainder) / record.floor[Tap.MEAS] ** 2
    yield {"skew": float(skews[int(np.argmin(remainders))])}


CLOCK_SKEW = Effect(
    id="clock_skew",
    title="Clock skew",
    summary="A lag of the reading that grows along the record.",
    stage=EffectStage.SENSOR,
    kinds=EVERY_KIND,
    identification=IdentificationHints(starts=_start_from_best_skew),
    kinship=EffectRelations(prior=0.5),
    formulations=(
        Formulation(
            name="constant_rate",
            equation="y(t) = q(t − 10⁻⁶ r t), t from the start of the run",
            source="Allan, IEEE Trans. UFFC 34 (1987) 647–654",
            parameters=(
                EffectParameter("skew", "r; above 0: readings come later", "ppm", -1e4, 1e4, 100.0),
            ),
            acts=ClockSkew(rate=lambda values: 1e-6 * values["skew"]),
            traits=frozenset(
                {
                    EffectTrait.LINEAR,
                    EffectTrait.MEMORYLESS,
                    EffectTrait.TRANSIENT,
                    EffectTrait.READING_ONLY,
                }
            ),
        ),
    ),
)
