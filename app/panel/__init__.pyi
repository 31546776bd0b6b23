from .panel import (
    STALE_AGE_S as STALE_AGE_S,
    PaletteOffer as PaletteOffer,
    Panel as Panel,
    PanelArea as PanelArea,
    get_palette_offer as get_palette_offer,
    make_panel as make_panel,
    offer_in_palette as offer_in_palette,
)
