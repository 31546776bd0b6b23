from .examination import (
    AxisExamination as AxisExamination,
    examine as examine,
)
from .examination_order import (
    order_axes as order_axes,
)
