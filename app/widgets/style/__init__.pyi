from . import theme as theme
from .delayed_work import (
    OnStyleChange as OnStyleChange,
    OnVisible as OnVisible,
    grow_with_text as grow_with_text,
    reserve_width as reserve_width,
)
from .painted_in_turn import (
    StaggeredPainting as StaggeredPainting,
)
from .theme import (
    THEMES as THEMES,
    Theme as Theme,
)
