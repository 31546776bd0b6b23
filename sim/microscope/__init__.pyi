from .cell import (
    UNTOUCHED_CELL_STATE as UNTOUCHED_CELL_STATE,
    SimulatedCell as SimulatedCell,
    advance_cell_state as advance_cell_state,
)
from .optics import (
    DEFAULT_APERTURE as DEFAULT_APERTURE,
    DEFAULT_MAGNIFICATION as DEFAULT_MAGNIFICATION,
    DEFAULT_PIXEL_SIZE_M as DEFAULT_PIXEL_SIZE_M,
)
from .renderer import (
    DEFAULT_EXPOSURE_S as DEFAULT_EXPOSURE_S,
    SceneRenderer as SceneRenderer,
)
from .scene import (
    MicroscopeScene as MicroscopeScene,
    TaperedPin as TaperedPin,
)
