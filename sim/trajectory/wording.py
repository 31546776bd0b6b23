"""Values in messages: a number with the unit that a person would choose."""

from rotemina.sim.units import symbol, to_unit

# Smallest size (SI) from which each unit reads well, largest unit first.
_STEPS = {
    "m": (("m", 1.0), ("mm", 1e-4), ("um", 1e-7), ("nm", 0.0)),
    "rad": (("rad", 0.1), ("mrad", 1e-3), ("urad", 0.0)),
}


def readable(value: float, unit: str, *, scale: float | None = None) -> str:
    """Return an SI value as text: ``readable(2e-5, "m")`` is ``"20 µm"``.

    Only lengths and angles change their unit, also inside a speed or an acceleration
    (``"m/s"``). ``scale`` is the value (SI) that chooses the unit, where two numbers of one
    message shall share it.
    """
    quantity, slash, rest = unit.partition("/")
    steps = _STEPS.get(quantity)
    size = abs(value if scale is None else scale)
    if steps is None or size == 0.0:
        return f"{value:.6g} {unit}"
    chosen = next(name for name, least in steps if size >= least)
    return f"{float(to_unit(value, chosen)):.6g} {symbol(chosen)}{slash}{rest}"
