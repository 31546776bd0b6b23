from .boards import (
    VirtualBoards as VirtualBoards,
)
from .fault_injection import (
    RandomFaults as RandomFaults,
    inject_fault as inject_fault,
)
