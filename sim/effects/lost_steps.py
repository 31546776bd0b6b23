"""Lost steps: an overloaded stepper falls into a later detent, four full steps off."""

import numpy as np

from rotemina.sim.effects.formulation import (
    Drive,
    Effect,
    Formulation,
    Parameter,
    Stage,
    Trait,
)
from rotemina.sim.effects.identification import Identification, Sign

_STEPS = 4.0  # full steps of one electrical period
_LONG_S = 1e8  # longer than any run: the way to the start
_INNER_SHARE = 1.0 / 40.0  # of the axis' period: how finely the lag is watched


def overload(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + n P``: n moves towards the axis as soon as it is further than ``limit`` from y.

    The field looks the same every P, so the axis settles in the detent that is nearest when it
    tears off. p: limit, P; s: n.
    """
    lag = x + s[0] * p[1] - other
    if h > 0.0 and abs(lag) > p[0]:
        slips = np.floor((abs(lag) - p[0]) / p[1]) + 1.0
        s[0] += -slips if lag > 0.0 else slips
    return x + s[0] * p[1]


def event(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + n P`` from t₁ on; the mean while h lasts, so smooth in t₁. p: t₁, n P."""
    if h > _LONG_S or t + h < p[0]:
        return x
    if t >= p[0]:
        return x + p[1]
    return x + p[1] * (t + h - p[0]) / h


LOST_STEPS = Effect(
    id="lost_steps",
    title="Lost steps",
    summary="Permanent jumps by multiples of four full steps, at high load.",
    stage=Stage.ACTUATOR,
    kinds=frozenset({"stepper"}),
    identification=Identification(shows_as=Sign.JUMPS, fitted=False),
    formulations=(
        Formulation(
            name="overload",
            equation="n → n ∓ 1 when ±(x + 4 n full steps − q) > limit; y = x + 4 n full steps",
            source="Kenjo and Sugawara, Stepping Motors and Their Microprocessor Controls, "
            "2nd ed. (1994), ch. 4: past two full steps the torque pulls to the next detent",
            parameters=(
                Parameter(
                    "limit",
                    "limit of the lag behind the field",
                    "q",
                    2.0,
                    40.0,
                    2.0,
                    per="full_step",
                ),
            ),
            acts=Drive(step=overload, states=1, timed=True),
            prepare=lambda values, facts: (values["limit"], _STEPS * facts.full_step),
            inner_step_s=lambda _, facts: _INNER_SHARE / facts.pace_hz,
        ),
        Formulation(
            name="event",
            equation="y = x + 4 n full steps from t₁ on",
            source="definition",
            parameters=(
                Parameter("time", "t₁, from the start of the run", "s", 0.0, 1e6, 1.0),
                Parameter(
                    "slips",
                    "n; an integer on a machine, any number here so that a fit can vary it",
                    "",
                    -1000.0,
                    1000.0,
                    -1.0,
                ),
            ),
            acts=Drive(step=event),
            prepare=lambda values, facts: (
                values["time"],
                _STEPS * facts.full_step * values["slips"],
            ),
            traits=frozenset({Trait.LOCKED_TO_TIME}),
        ),
    ),
)
