from .camera import (
    Camera as Camera,
    CameraIdentity as CameraIdentity,
    FocusDrive as FocusDrive,
    RawFrame as RawFrame,
)
from .frame import (
    CameraFrame as CameraFrame,
    Pixels as Pixels,
    PixelType as PixelType,
    SensorRegion as SensorRegion,
)
from .hub import (
    CameraHub as CameraHub,
)
from .pace import (
    FramePacer as FramePacer,
)
from .settings import (
    CameraDescription as CameraDescription,
    CameraSettings as CameraSettings,
    CameraTrigger as CameraTrigger,
)
from .simulated import (
    SimulatedMicroscope as SimulatedMicroscope,
)
from .source import (
    CameraSource as CameraSource,
)
