from .comparison import (
    ModelComparison as ModelComparison,
    TapComparison as TapComparison,
    compare as compare,
)
from .comparison_picture import (
    draw_figure as draw_figure,
    find_picture_format as find_picture_format,
    save_figure as save_figure,
)
from .gap import (
    GapFigure as GapFigure,
    compute_gap_course as compute_gap_course,
    compute_gap_figure as compute_gap_figure,
    find_moving_samples as find_moving_samples,
    format_gap as format_gap,
)
from .noise_floor import (
    find_noise_floor as find_noise_floor,
)
from .run_comparison import (
    compare_runs as compare_runs,
)
from .table import (
    TABLE_HEAD as TABLE_HEAD,
    format_cells as format_cells,
    format_runs_table as format_runs_table,
    format_table as format_table,
)
