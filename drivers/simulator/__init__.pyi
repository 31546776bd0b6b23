from .device import (
    SimulatedDevice as SimulatedDevice,
)
from .driver import (
    Simulator as Simulator,
)
from .setpoint_generator import (
    SetpointGenerator as SetpointGenerator,
)
