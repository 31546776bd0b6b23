"""Units of the quantities that a report shows."""

from collections.abc import Sequence

from rotemina.sim.records.record import Record, Tap


def unit_of(axis: str, tap: Tap, records: Sequence[Record]) -> str:
    """Return the SI unit of a tap, as the records have it."""
    if tap is Tap.U:
        return "V"
    return next((record.units[axis] for record in records if axis in record.axes), "")


def named_unit(unit: str, source_unit: str) -> str:
    """Return a parameter's unit, completed by the unit of the axis that it originates in."""
    return "" if unit == f"{source_unit}/…" else unit.replace("…", source_unit or "…")
