from .quantities import (
    DisplayScale as DisplayScale,
    align_columns as align_columns,
    choose_scale as choose_scale,
    format_exact as format_exact,
    format_interval as format_interval,
    format_percent as format_percent,
    format_percent_interval as format_percent_interval,
    format_quantity as format_quantity,
    make_scale as make_scale,
)
from .units import (
    display_symbol_of as display_symbol_of,
    from_unit as from_unit,
    parse_unit as parse_unit,
    per_si as per_si,
    si_unit_of as si_unit_of,
    to_unit as to_unit,
    units_of as units_of,
)
