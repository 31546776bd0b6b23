import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotemina.sim.errors import UnitError
from rotemina.sim.units import units

ALL_UNITS = [unit for si in ("m", "rad", "V", "s") for unit in units.units_of(si)]


@pytest.mark.parametrize("text", ["581.7", "3", "-7.3e-5"])
@pytest.mark.parametrize(("unit", "exponent"), [("mm", -3), ("um", -6), ("nm", -9), ("urad", -6)])
def test_a_decimal_unit_gives_the_nearest_float64(text: str, unit: str, exponent: int) -> None:
    mantissa, _, power = text.partition("e")
    nearest = float(f"{mantissa}e{int(power or 0) + exponent}")
    # The text is rounded to a float64, and the division rounds a second time.
    assert abs(units.from_unit(float(text), unit) - nearest) <= math.ulp(nearest)
    if float(text).is_integer():
        assert units.from_unit(float(text), unit) == nearest


@pytest.mark.parametrize("unit", ["m", "rad", "V", "s"])
@given(value=st.floats(allow_nan=False))
def test_an_si_unit_changes_no_bit(unit: str, value: float) -> None:
    assert units.from_unit(value, unit).tobytes() == np.float64(value).tobytes()
    assert units.to_unit(value, unit).tobytes() == np.float64(value).tobytes()


@pytest.mark.parametrize("unit", ALL_UNITS)
@given(value=st.floats(-1e290, 1e290))
def test_a_value_is_restored_within_two_ulp(unit: str, value: float) -> None:
    restored = float(units.from_unit(units.to_unit(value, unit), unit))
    assert abs(restored - value) <= 2 * math.ulp(value)


def test_angles_are_converted_by_their_definition() -> None:
    assert units.from_unit(180.0, "deg") == pytest.approx(math.pi, rel=1e-15)
    assert units.from_unit(3600.0, "arcsec") == pytest.approx(math.radians(1.0), rel=1e-15)
    assert units.to_unit(1e-3, "mrad") == 1.0


def test_arrays_keep_their_shape() -> None:
    assert units.from_unit(np.array([[1.0, 2.0]]), "mm").tolist() == [[1e-3, 2e-3]]


@pytest.mark.parametrize("spelling", ["um", "µm", "μm"])
def test_micro_can_be_spelled_in_three_ways(spelling: str) -> None:
    assert units.parse_unit(spelling) == "um"
    assert units.display_symbol_of(spelling) == "\N{MICRO SIGN}m"


@pytest.mark.parametrize("unit", ["", "mV", "um ", "Rad"])
def test_an_unknown_unit_is_refused_with_the_known_ones(unit: str) -> None:
    with pytest.raises(UnitError, match=r"unknown unit .* use one of m mm um nm"):
        units.si_unit_of(unit)


def test_a_list_of_units_begins_with_the_si_unit() -> None:
    assert units.units_of("m") == ("m", "mm", "um", "nm")
    assert units.units_of("rad")[0] == "rad"
    with pytest.raises(UnitError, match="'mm' is not an SI unit"):
        units.units_of("mm")
