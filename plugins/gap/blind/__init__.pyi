from .blind_page import (
    BlindPage as BlindPage,
)
from .hidden_machine import (
    HiddenMachineTrial as HiddenMachineTrial,
)
