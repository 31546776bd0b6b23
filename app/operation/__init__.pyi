from .operation import (
    OperatorControl as OperatorControl,
    has_tip as has_tip,
)
