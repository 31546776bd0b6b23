from .device_link import (
    DeviceLink as DeviceLink,
)
from .mailbox import (
    ClearFaultCommand as ClearFaultCommand,
    Command as Command,
    ConnectionRequest as ConnectionRequest,
    EffectsCommand as EffectsCommand,
    HomeCommand as HomeCommand,
    InverseCommand as InverseCommand,
    LoadProfileCommand as LoadProfileCommand,
    LoopCommand as LoopCommand,
    MoveCommand as MoveCommand,
    PlayCommand as PlayCommand,
    RunProfileCommand as RunProfileCommand,
    VelocityCommand as VelocityCommand,
    VoltageCommand as VoltageCommand,
    refuse_invalidated_permit as refuse_invalidated_permit,
    require_ability as require_ability,
)
from .ownership import (
    HOMING as HOMING,
    OPERATOR as OPERATOR,
    PLAYBACK as PLAYBACK,
)
from .recent_history import (
    HistoryWindow as HistoryWindow,
    LiveHistory as LiveHistory,
)
from .sensor_corrections import (
    AppliedCalibration as AppliedCalibration,
    SensorCorrections as SensorCorrections,
)
from .subscribers import (
    SessionSubscribers as SessionSubscribers,
)
from .ticker import (
    Ticker as Ticker,
)
from .worker import (
    SessionWorker as SessionWorker,
)
