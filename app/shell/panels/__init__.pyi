from .deferred_panels import (
    DeferredPanelLoader as DeferredPanelLoader,
)
from .panel_declarations import (
    PanelKind as PanelKind,
)
from .panel_host import (
    PanelCollection as PanelCollection,
    find_panels as find_panels,
    make_panel_subject as make_panel_subject,
)
from .panel_news import (
    PanelNews as PanelNews,
)
from .panel_watch import (
    PanelWatch as PanelWatch,
)
