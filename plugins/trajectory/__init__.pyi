from .playback_controls import (
    PlayButton as PlayButton,
    describe_waiting as describe_waiting,
)

def mark(text: str) -> str: ...
def tr(text: str) -> str: ...
