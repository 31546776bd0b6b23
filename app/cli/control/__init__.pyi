from .compensate import (
    load_named_inverse as load_named_inverse,
)
