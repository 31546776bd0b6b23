from .autofocus import (
    AutofocusSearch as AutofocusSearch,
    FocusPeak as FocusPeak,
    measure_sharpness as measure_sharpness,
)
from .background import (
    BackgroundImage as BackgroundImage,
)
from .background_drift import (
    BackgroundDrift as BackgroundDrift,
    measure_background_drift as measure_background_drift,
)
from .body_fit import (
    BodyPart as BodyPart,
)
from .calibration import (
    StageFit as StageFit,
    StageMap as StageMap,
    StageMapGeometry as StageMapGeometry,
    fit_stage as fit_stage,
)
from .cell import (
    CellOutline as CellOutline,
    MembraneAhead as MembraneAhead,
    find_cell as find_cell,
    find_membrane_ahead as find_membrane_ahead,
)
from .image import (
    Image as Image,
    divide_by_background as divide_by_background,
    to_grey as to_grey,
)
from .pipette import (
    Pipette as Pipette,
)
from .registration import (
    register_images as register_images,
)
from .tip_fit import (
    TipDepth as TipDepth,
    TipFit as TipFit,
    fit_tip as fit_tip,
)
from .tip_search import (
    find_likeliest_place as find_likeliest_place,
    find_tip as find_tip,
    find_tip_in_any_direction as find_tip_in_any_direction,
    fit_from_depths as fit_from_depths,
    is_plausible as is_plausible,
)
from .tracking import (
    TipTrack as TipTrack,
    begin_track as begin_track,
    follow_tip as follow_tip,
    learn_body as learn_body,
)
