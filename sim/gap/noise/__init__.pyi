from .disturbances import (
    Disturbance as Disturbance,
    by_effect as by_effect,
    power_by_tap as power_by_tap,
    set_aside as set_aside,
)
from .reading_step_effect import (
    steps_of as steps_of,
)
from .sensor_wander import (
    wander as wander,
)
