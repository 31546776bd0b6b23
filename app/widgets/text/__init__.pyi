from .figures import (
    ValueGrid as ValueGrid,
)
from .fitted_text import (
    FittedButton as FittedButton,
)
from .labels import (
    ElidedLabel as ElidedLabel,
    LiveLabel as LiveLabel,
    make_colour_legend as make_colour_legend,
    make_heading as make_heading,
    make_hint as make_hint,
    make_plain_label as make_plain_label,
    reserve_lines as reserve_lines,
    show_or_hide_text as show_or_hide_text,
)
from .table import (
    TextTable as TextTable,
)
