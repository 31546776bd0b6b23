from .frames import (
    FrameCoordinate as FrameCoordinate,
)
from .impedance import (
    ImpedanceLaw as ImpedanceLaw,
)
from .linear_laws import (
    LinearPositionLaw as LinearPositionLaw,
    LinearRateLaw as LinearRateLaw,
)
from .modes import (
    ALL_AXES_MODE as ALL_AXES_MODE,
    TIP_MODES as TIP_MODES,
)
from .recentring import (
    RecentringPlan as RecentringPlan,
    plan_recentring as plan_recentring,
    plan_with_tip_held as plan_with_tip_held,
)
from .scales import (
    CoordinateScale as CoordinateScale,
    LawKind as LawKind,
    ModeScales as ModeScales,
)
from .scaling import (
    STEP_PRESETS as STEP_PRESETS,
)
from .teleoperation_loop import (
    Teleoperator as Teleoperator,
)
from .teleoperation_state import (
    CoordinateView as CoordinateView,
    TeleoperationState as TeleoperationState,
)
from .virtual_impedance import (
    PerceivedDynamics as PerceivedDynamics,
)
