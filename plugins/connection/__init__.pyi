from .unavailable_reasons import (
    find_homing_objection as find_homing_objection,
    find_rest_objection as find_rest_objection,
    find_teach_objection as find_teach_objection,
    find_undo_objection as find_undo_objection,
)

def mark(text: str) -> str: ...
def tr(text: str) -> str: ...
