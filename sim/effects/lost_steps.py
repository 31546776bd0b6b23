"""Lost steps: an overloaded stepper falls into a later detent, four full steps away."""

import numpy as np

from rotemina.sim.effects.formulation import (
    Effect,
    EffectParameter,
    EffectStage,
    EffectTrait,
    Formulation,
    InputFunction,
)
from rotemina.sim.effects.identification import EffectSignature, IdentificationHints

# Full steps of one electrical period.
_FULL_STEPS_PER_PERIOD = 4.0
# An input held longer than any run lasts stands for the approach to the start of the run.
_MIN_INITIAL_HOLD_S = 1e8
# Inner step in periods of the axis, fine enough to follow the lag.
_INNER_STEP_PERIODS = 1.0 / 40.0


def apply_overload(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + n P``: n moves towards the axis when it is further than ``limit`` from y.

    The field repeats every P, so the axis settles in the detent that is nearest when it breaks
    away. p: limit, P; s: n.
    """
    lag = x + s[0] * p[1] - other
    if h > 0.0 and abs(lag) > p[0]:
        slips = np.floor((abs(lag) - p[0]) / p[1]) + 1.0
        s[0] += -slips if lag > 0.0 else slips
    return x + s[0] * p[1]


def apply_event(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """Apply ``y = x + n P`` from t₁ on. p: t₁, n P.

    The mean over the step is returned, so that the result is continuous in t₁.
    """
    if h > _MIN_INITIAL_HOLD_S or t + h < p[0]:
        return x
    if t >= p[0]:
        return x + p[1]
    return x + p[1] * (t + h - p[0]) / h


LOST_STEPS = Effect(
    id="lost_steps",
    title="Lost steps",
    summary="Permanent jumps by multiples of four full steps, at high load.",
    stage=EffectStage.ACTUATOR,
    kinds=frozenset({"stepper"}),
    identification=IdentificationHints(shows_as=EffectSignature.JUMPS, fitted=False),
    formulations=(
        Formulation(
            name="overload",
            equation="n → n ∓ 1 when ±(x + 4 n full steps − q) > limit; y = x + 4 n full steps",
            source="Kenjo and Sugawara, Stepping Motors and Their Microprocessor Controls, "
            "2nd ed. (1994), ch. 4: past two full steps the torque pulls to the next detent",
            parameters=(
                EffectParameter(
                    "limit",
                    "limit of the lag behind the field",
                    "q",
                    2.0,
                    40.0,
                    2.0,
                    per="full_step",
                ),
            ),
            acts=InputFunction(step=apply_overload, states=1, timed=True),
            prepare=lambda values, facts: (
                values["limit"],
                _FULL_STEPS_PER_PERIOD * facts.full_step,
            ),
            inner_step_s=lambda _, facts: _INNER_STEP_PERIODS / facts.pace_hz,
        ),
        Formulation(
            name="event",
            equation="y = x + 4 n full steps from t₁ on",
            source="definition",
            parameters=(
                EffectParameter("time", "t₁, from the start of the run", "s", 0.0, 1e6, 1.0),
                EffectParameter(
                    "slips",
                    "n; an integer on a machine, any number here so that a fit can vary it",
                    "",
                    -1000.0,
                    1000.0,
                    -1.0,
                ),
            ),
            acts=InputFunction(step=apply_event),
            prepare=lambda values, facts: (
                values["time"],
                _FULL_STEPS_PER_PERIOD * facts.full_step * values["slips"],
            ),
            traits=frozenset({EffectTrait.LOCKED_TO_TIME}),
        ),
    ),
)
