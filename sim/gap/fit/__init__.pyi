from .descent import (
    begun as begun,
    descend as descend,
    one_step as one_step,
)
from .effect_catalogue import (
    baseline as baseline,
    brought_along as brought_along,
    by_spectra as by_spectra,
    catalogue as catalogue,
    is_of as is_of,
    is_own as is_own,
    is_whole_own as is_whole_own,
    kinship_of as kinship_of,
    shown_as as shown_as,
    with_parameter as with_parameter,
)
from .evidence import (
    Evidence as Evidence,
    Observation as Observation,
    Part as Part,
    Signals as Signals,
    block_rows as block_rows,
)
from .fit_starts import (
    starts as starts,
)
from .held_out_folds import (
    folds as folds,
    held_out as held_out,
)
from .output_error import (
    NUMERICAL as NUMERICAL,
    Fit as Fit,
    bounds as bounds,
    finished as finished,
    fit as fit,
    free_parameters as free_parameters,
    lost as lost,
    residual_of as residual_of,
    sketched as sketched,
    with_values as with_values,
)
from .position_origins import (
    origin_remarks as origin_remarks,
    with_origins as with_origins,
)
from .reading_cells import (
    cell_of as cell_of,
    floor_beyond as floor_beyond,
)
from .row_blocks import (
    Blocks as Blocks,
    block_numbers as block_numbers,
    drawn_means as drawn_means,
    summed as summed,
)
