from .axis_calibration import (
    DEFAULT_DEAD_ZONE as DEFAULT_DEAD_ZONE,
    InputAxisCalibration as InputAxisCalibration,
    InputCalibration as InputCalibration,
    to_uncalibrated_raw as to_uncalibrated_raw,
)
from .input_arbiter import (
    InputArbiter as InputArbiter,
    InputDeviceView as InputDeviceView,
    InputDisplayState as InputDisplayState,
)
from .input_devices import (
    InputDevices as InputDevices,
    InputSnapshot as InputSnapshot,
)
from .intent import (
    Intent as Intent,
    OperatorAction as OperatorAction,
)
from .mapped_device import (
    InputAxisView as InputAxisView,
)
from .moved_control import (
    ControlDetector as ControlDetector,
    ControlKind as ControlKind,
    DetectionResult as DetectionResult,
    MovedControl as MovedControl,
)
from .profile import (
    ActionMapping as ActionMapping,
    AxisMapping as AxisMapping,
    DeviceMapping as DeviceMapping,
    InputProfile as InputProfile,
    ListedProfile as ListedProfile,
    OperatorRole as OperatorRole,
    SilencePolicy as SilencePolicy,
)
from .profile_check import (
    DEGREES_OF_FREEDOM as DEGREES_OF_FREEDOM,
    PluggedDevice as PluggedDevice,
    assign_mappings as assign_mappings,
    check_profile as check_profile,
)
from .stick_calibration import (
    StickCalibrationRun as StickCalibrationRun,
)
