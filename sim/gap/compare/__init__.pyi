from . import calibration as calibration
from .added_modes import (
    many_modes as many_modes,
)
from .calibration import (
    FORMAT as FORMAT,
    Calibration as Calibration,
    probabilities as probabilities,
)
from .cause_contest import (
    Ranking as Ranking,
    contested as contested,
    rivals_of as rivals_of,
)
from .companions import (
    accompanied as accompanied,
)
from .effect_candidates import (
    candidates as candidates,
    scouts as scouts,
)
from .excitation_richness import (
    is_poor as is_poor,
)
from .explanations import (
    Explanation as Explanation,
    counted_in as counted_in,
    explain as explain,
    mean_squares as mean_squares,
    named_as as named_as,
    untouched as untouched,
)
from .forward_selection import (
    Selection as Selection,
)
from .gap_shrinkage import (
    LeftBy as LeftBy,
    at_tap as at_tap,
    closing as closing,
    rms as rms,
    shrinkage as shrinkage,
)
from .repeated_search import (
    acts as acts,
    searched as searched,
)
from .retained import (
    with_retained as with_retained,
)
from .rivals import (
    Key as Key,
    Rival as Rival,
    not_ruled_out as not_ruled_out,
    paired_blocks as paired_blocks,
    probability as probability,
)
from .verdict import (
    Closing as Closing,
    decide as decide,
    is_sure as is_sure,
)
