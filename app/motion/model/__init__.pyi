from .bracketed_model import (
    BracketedModel as BracketedModel,
)
from .command_memory import (
    CommandMemory as CommandMemory,
)
from .live_models import (
    ModelOutputs as ModelOutputs,
    PreparedModel as PreparedModel,
    SessionModels as SessionModels,
)
from .model_deviation_watch import (
    DeviationWatch as DeviationWatch,
    PlaybackGap as PlaybackGap,
)
from .model_in_use import (
    CONTACT_LIKE_EFFECTS as CONTACT_LIKE_EFFECTS,
    NOTED_KEY as NOTED_KEY,
    MachineIdentity as MachineIdentity,
    ModelInUse as ModelInUse,
    compute_fingerprint as compute_fingerprint,
)
