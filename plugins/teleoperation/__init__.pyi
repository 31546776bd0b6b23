from .wording import (
    describe_state as describe_state,
    describe_trust as describe_trust,
    explain_no_motion as explain_no_motion,
    list_law_texts as list_law_texts,
    make_mode_texts as make_mode_texts,
    name_driving_devices as name_driving_devices,
)

def mark(text: str) -> str: ...
def tr(text: str) -> str: ...
