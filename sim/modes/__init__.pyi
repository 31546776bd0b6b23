from .vibration import (
    compute_damped_modes as compute_damped_modes,
)
