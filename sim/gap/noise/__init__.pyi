from .coarse_reading import (
    steps_of as steps_of,
)
from .disturbances import (
    Disturbance as Disturbance,
    by_effect as by_effect,
    power_by_tap as power_by_tap,
    set_aside as set_aside,
)
from .sensor_wander import (
    wander as wander,
)
