"""Many modes at once, each with its own shares of deflection and speed."""

from collections.abc import Iterator

import numpy as np

from rotemina.sim.effects.facts import Facts
from rotemina.sim.effects.formulation import LinearPart, Parameter, Values

MODES = 16
_TYPICAL = 0.05  # share of the first mode in the preset; the others have none
_FIRST, _APART = 1.7, 1.15  # frequencies in the preset: of the first over the axis', and a ratio


def modal_parameters(unit: str) -> tuple[Parameter, ...]:
    """Return frequency, damping and both shares, which have a unit, of each mode."""
    return tuple(_each(unit))


def _each(unit: str) -> Iterator[Parameter]:
    for n in range(MODES):
        typical, share = _FIRST * _APART**n, 0.0 if n else _TYPICAL
        yield Parameter(
            f"frequency_{n + 1}", "of the mode", "Hz", 1e-6, 1e3, typical, per="pace_hz"
        )
        yield Parameter(f"damping_ratio_{n + 1}", "of the mode", "", 1e-6, 1e6, 0.03)
        yield Parameter(
            f"share_{n + 1}", "a, share of the mode's deflection", unit, -1e9, 1e9, share
        )
        yield Parameter(
            f"speed_share_{n + 1}", "b, share of the mode's speed over ω", unit, -1e9, 1e9, 0.0
        )


def modal_part(values: Values, _facts: Facts) -> LinearPart:
    """Return ``Σ aₖ zₖ + bₖ żₖ/ωₖ`` with ``z̈ₖ + 2ζₖωₖ żₖ + ωₖ² zₖ = ωₖ² U``.

    The states are zₖ and żₖ/ωₖ, mode after mode.
    """
    a, b = np.zeros((2 * MODES, 2 * MODES)), np.zeros((2 * MODES, 3))
    output = np.zeros(2 * MODES)
    for k in range(MODES):
        n, own = k + 1, slice(2 * k, 2 * k + 2)
        rate = 2.0 * np.pi * values[f"frequency_{n}"]
        a[own, own] = [[0.0, rate], [-rate, -2.0 * values[f"damping_ratio_{n}"] * rate]]
        b[2 * k + 1, 2] = rate
        output[own] = values[f"share_{n}"], values[f"speed_share_{n}"]
    return LinearPart(a=a, b=b, output=output)
