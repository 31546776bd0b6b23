"""A characteristic that is bent over a stretch of the range, as a sine series."""

import numpy as np

from rotemina.sim.effects.formulation import Parameter, Values

EQUATION = "y = x + S Σ aₖ sin kπz, k = 1…4, z = 0…1 along the stretch; y = x outside"
SOURCE = (
    "Pintelon and Schoukens, System Identification, 2nd ed. (2012), ch. 3: static nonlinearities"
)
_SINES = ("sine_1", "sine_2", "sine_3", "sine_4")


def bent(x, other, t, h, a, b, p, s):  # type: ignore[no-untyped-def]  # compiled
    """``y = x + Σ p[1+k] sin kπz``, z = (x − p[0])·p[1]. p: begin, 1/length, four amplitudes."""
    z = (x - p[0]) * p[1]
    if z <= 0.0 or z >= 1.0:
        return x
    sine, twice = np.sin(np.pi * z), 2.0 * np.cos(np.pi * z)
    second = twice * sine
    third = twice * second - sine
    return x + p[2] * sine + p[3] * second + p[4] * third + p[5] * (twice * third - second)


def parameters() -> tuple[Parameter, ...]:
    """Return the stretch and the amplitudes, all as shares of the range."""
    return (
        Parameter(
            "begin", "start of the section, from the low end of the range", "", 0.0, 1.0, 0.0
        ),
        Parameter("end", "end of the section", "", 0.0, 1.0, 1.0),
        Parameter(_SINES[0], "a₁, curvature", "", -0.2, 0.2, 0.005, linear=True),
        *(
            Parameter(name, f"a{k}", "", -0.2, 0.2, 0.0, linear=True)
            for name, k in zip(_SINES[1:], "₂₃₄", strict=True)
        ),
    )


def numbers(values: Values, low: float, span: float) -> tuple[float, ...]:
    """Return what :func:`bent` reads, over a range from ``low`` of length ``span``."""
    length = (values["end"] - values["begin"]) * span
    amplitudes = (span * values[name] for name in _SINES)
    return low + values["begin"] * span, 1.0 / length if length > 0.0 else 0.0, *amplitudes
