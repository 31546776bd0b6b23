from .axes import (
    DeviceAxis as DeviceAxis,
)
from .driver import (
    Clock as Clock,
    Driver as Driver,
    MachineKind as MachineKind,
    VirtualClock as VirtualClock,
)
from .errors import (
    BudgetError as BudgetError,
    CameraLostError as CameraLostError,
    CameraReadError as CameraReadError,
    CameraRefusedError as CameraRefusedError,
    CameraSettingError as CameraSettingError,
    ConnectionLostError as ConnectionLostError,
    DescriptorError as DescriptorError,
    DeviceResetError as DeviceResetError,
    DriverError as DriverError,
    DriverSettingError as DriverSettingError,
    DriverTimeoutError as DriverTimeoutError,
    FaultCommandError as FaultCommandError,
    GateError as GateError,
    InputLostError as InputLostError,
    LimitError as LimitError,
    ProtocolError as ProtocolError,
    ScriptError as ScriptError,
    StalePermitError as StalePermitError,
    StateError as StateError,
)
from .gate import (
    Gate as Gate,
    GateEpoch as GateEpoch,
    Permit as Permit,
    PermitPurpose as PermitPurpose,
)
from .line_quality import (
    LinkQuality as LinkQuality,
    combine_link_quality as combine_link_quality,
)
from .reading_check import (
    NEW_POSITION_REPORT_COUNT as NEW_POSITION_REPORT_COUNT,
    ReadingBounds as ReadingBounds,
    ReadingCheck as ReadingCheck,
)
from .registry import (
    discover_drivers as discover_drivers,
    discover_plugins as discover_plugins,
    find_driver as find_driver,
    load_class as load_class,
    make_sources as make_sources,
)
from .samples import (
    DeviceSamples as DeviceSamples,
    DeviceState as DeviceState,
    DeviceStatus as DeviceStatus,
)
from .settings import (
    SettingValue as SettingValue,
)
