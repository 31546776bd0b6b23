from .board import (
    BoardJoystickSource as BoardJoystickSource,
)
from .device import (
    InputDevice as InputDevice,
    InputIdentity as InputIdentity,
    InputReading as InputReading,
    InputSource as InputSource,
    RumbleDevice as RumbleDevice,
)
from .hid_discovery import (
    HidSource as HidSource,
)
from .hub import (
    InputChanges as InputChanges,
    InputHub as InputHub,
)
from .pad import (
    InputPad as InputPad,
)
from .script import (
    InputScript as InputScript,
)
from .scripted import (
    ScriptedSource as ScriptedSource,
)
