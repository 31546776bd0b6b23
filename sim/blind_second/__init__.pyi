from .case import (
    draw_second_case as draw_second_case,
)
