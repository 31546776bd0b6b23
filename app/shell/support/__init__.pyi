from .event_loop_watch import (
    EventLoopWatch as EventLoopWatch,
)
from .log_page import (
    LogDialog as LogDialog,
)
from .message_log import (
    MessageLog as MessageLog,
)
from .support_page import (
    SupportDialog as SupportDialog,
)
