from .approaches import (
    find_holds as find_holds,
)
from .comparable_parts import (
    compare_with_laser as compare_with_laser,
)
from .correction import (
    ReadingCorrection as ReadingCorrection,
)
from .iso230 import (
    PositioningFigures as PositioningFigures,
)
from .laser_join import (
    join_laser_record as join_laser_record,
)
from .plan import (
    DEFAULT_RATE_HZ as DEFAULT_RATE_HZ,
    DEFAULT_RUNS as DEFAULT_RUNS,
    DEFAULT_TARGETS as DEFAULT_TARGETS,
    make_calibration_motion as make_calibration_motion,
)
from .sensor import (
    MAX_BEND_COEFFICIENTS as MAX_BEND_COEFFICIENTS,
    STOP_RADIUS_SHARES as STOP_RADIUS_SHARES,
    SensorModel as SensorModel,
)
from .sensor_calibration import (
    SensorCalibration as SensorCalibration,
    SensorFigureEstimate as SensorFigureEstimate,
    calibrate_sensor as calibrate_sensor,
)
from .sensor_lag import (
    MAX_LAG_S as MAX_LAG_S,
    SensorLag as SensorLag,
)
