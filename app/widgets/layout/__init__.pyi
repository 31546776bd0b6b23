from .flow_layout import (
    FlowLayout as FlowLayout,
)
from .inline_question import (
    InlineQuestion as InlineQuestion,
)
from .layouts import (
    keep_room_when_hidden as keep_room_when_hidden,
    make_column as make_column,
    make_grid as make_grid,
    make_row as make_row,
)
from .scroll_areas import (
    FittedScrollArea as FittedScrollArea,
    PanelFrame as PanelFrame,
    find_frame as find_frame,
    fix_width as fix_width,
    lay_out_with_controls as lay_out_with_controls,
    make_scroll_area as make_scroll_area,
    make_tabs as make_tabs,
)
from .section import (
    Section as Section,
    clear_layout as clear_layout,
)
