from .serial_port import (
    BytePort as BytePort,
    OpenPort as OpenPort,
    UrgentBytes as UrgentBytes,
    open_port as open_port,
)
