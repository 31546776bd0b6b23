from .plan_preview import (
    PlanPreview as PlanPreview,
)
from .run_bar import (
    RunButtons as RunButtons,
)
from .words import (
    describe_status as describe_status,
    format_headline as format_headline,
)

def mark(text: str) -> str: ...
def tr(text: str) -> str: ...
