from .heartbeat_sender import (
    HeartbeatSender as HeartbeatSender,
)
