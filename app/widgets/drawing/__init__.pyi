from .legend import (
    LegendEntry as LegendEntry,
    PlotLegend as PlotLegend,
)
from .plot import (
    AXIS_WIDTH_PX as AXIS_WIDTH_PX,
    LINE_STYLES as LINE_STYLES,
    NOISE_BAND_ALPHA as NOISE_BAND_ALPHA,
    RIGHT_MARGIN_PX as RIGHT_MARGIN_PX,
    LineStyle as LineStyle,
    SignalPlot as SignalPlot,
    drop_spare_plots as drop_spare_plots,
    make_spare_plot as make_spare_plot,
)
from .tip_frame import (
    TipProjection as TipProjection,
    draw_scale_bar as draw_scale_bar,
    find_round_length as find_round_length,
    make_forbidden_area as make_forbidden_area,
    round_down as round_down,
)
