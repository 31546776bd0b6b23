"""Sum of many modes, each with its own shares of deflection and speed."""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.effects.facts import AxisProperties
from rotemina.sim.effects.formulation import EffectParameter, LinearPart, Values

MODE_COUNT = 16
# Share of the first mode in the preset; the other modes have none.
_FIRST_MODE_SHARE = 0.05
# Preset frequencies: ratio of the first mode to the natural frequency of the axis, and of each mode
# to the previous one.
_FIRST_FREQUENCY_RATIO, _NEXT_FREQUENCY_RATIO = 1.7, 1.15


def make_modal_parameters(unit: str) -> tuple[EffectParameter, ...]:
    """Return frequency, damping ratio and both shares, in this unit, of each mode."""
    return tuple(_iterate_parameters(unit))


def _iterate_parameters(unit: str) -> Iterator[EffectParameter]:
    for n in range(MODE_COUNT):
        frequency_ratio, deflection_share = (
            _FIRST_FREQUENCY_RATIO * _NEXT_FREQUENCY_RATIO**n,
            0.0 if n else _FIRST_MODE_SHARE,
        )
        yield EffectParameter(
            f"frequency_{n + 1}", "of the mode", "Hz", 1e-6, 1e3, frequency_ratio, per="pace_hz"
        )
        yield EffectParameter(f"damping_ratio_{n + 1}", "of the mode", "", 1e-6, 1e6, 0.03)
        yield EffectParameter(
            f"share_{n + 1}", "a, share of the mode's deflection", unit, -1e9, 1e9, deflection_share
        )
        yield EffectParameter(
            f"speed_share_{n + 1}", "b, share of the mode's speed over ω", unit, -1e9, 1e9, 0.0
        )


def make_modal_part(values: Values, _facts: AxisProperties) -> LinearPart:
    """Return ``Σ aₖ zₖ + bₖ żₖ/ωₖ`` with ``z̈ₖ + 2ζₖωₖ żₖ + ωₖ² zₖ = ωₖ² U``.

    The states are zₖ and żₖ/ωₖ, mode after mode.
    """
    a, b = np.zeros((2 * MODE_COUNT, 2 * MODE_COUNT)), np.zeros((2 * MODE_COUNT, 3))
    output = np.zeros(2 * MODE_COUNT)
    for k in range(MODE_COUNT):
        n, mode_states = k + 1, slice(2 * k, 2 * k + 2)
        rate = 2.0 * np.pi * values[f"frequency_{n}"]
        a[mode_states, mode_states] = [
            [0.0, rate],
            [-rate, -2.0 * values[f"damping_ratio_{n}"] * rate],
        ]
        b[2 * k + 1, 2] = rate
        output[mode_states] = values[f"share_{n}"], values[f"speed_share_{n}"]
    return LinearPart(a=a, b=b, output=output)
