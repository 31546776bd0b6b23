"""The Plots panel: live plots of command, model and measurement of each axis.

``plot_grid`` arranges the plots, and ``axis_plot`` is one of them. A second run can be drawn over
the first (``overlay_…``). The plot widget for all panels is in ``app/widgets/drawing``.
"""

from rotemina.app.language import make_text_functions

tr, mark = make_text_functions("plots")
