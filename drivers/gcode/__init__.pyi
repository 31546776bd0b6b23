from .emulator import (
    EmulatedStage as EmulatedStage,
)
