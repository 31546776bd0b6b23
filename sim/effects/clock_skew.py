"""A sensor whose clock runs faster or slower than the controller's."""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.effects.formulation import (
    EVERY_KIND,
    Effect,
    Formulation,
    Parameter,
    Skew,
    Stage,
    Trait,
    Values,
)
from rotemina.sim.effects.identification import Identification, View
from rotemina.sim.effects.kinship import Kinship
from rotemina.sim.effects.starts import centred
from rotemina.sim.records.record import Tap

_PPM = 1e-6
_SKEWS = 40  # from 1 ppm on


def _skews(view: View) -> Iterator[Values]:
    """Give the rate at which the model's readings, read by such a clock, leave least."""
    low, high = view.bounds("skew")
    sizes = np.geomspace(1.0, high, _SKEWS)
    tried = np.concatenate([-sizes[sizes <= -low], sizes])
    left = np.zeros(len(tried))
    for record, answer in zip(view.records, view.answers, strict=True):
        if Tap.MEAS not in answer:
            continue
        time_s = record.time_s
        for number, skew in enumerate(tried):
            when = time_s - (time_s - time_s[0]) * _PPM * skew
            gap = centred(record.real[Tap.MEAS] - np.interp(when, time_s, answer[Tap.MEAS]))
            left[number] += float(gap @ gap) / record.floor[Tap.MEAS] ** 2
    yield {"skew": float(tried[int(np.argmin(left))])}


CLOCK_SKEW = Effect(
    id="clock_skew",
    title="Clock skew",
    summary="A lag of the reading that grows along the record.",
    stage=Stage.SENSOR,
    kinds=EVERY_KIND,
    identification=Identification(starts=_skews),
    kinship=Kinship(prior=0.5),
    formulations=(
        Formulation(
            name="constant_rate",
            equation="y(t) = q(t − 10⁻⁶ r t), t from the start of the run",
            source="Allan, IEEE Trans. UFFC 34 (1987) 647–654",
            parameters=(
                Parameter("skew", "r; above 0: readings come later", "ppm", -1e4, 1e4, 100.0),
            ),
            acts=Skew(rate=lambda values: 1e-6 * values["skew"]),
            traits=frozenset({Trait.LINEAR, Trait.MEMORYLESS, Trait.TRANSIENT, Trait.READING_ONLY}),
        ),
    ),
)
