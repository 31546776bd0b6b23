"""File locks that the system releases when a process ends."""

import os
from typing import BinaryIO

if os.name == "nt":  # pragma: no cover - the other system's half
    import msvcrt

    _BEHIND = 1 << 62  # a byte that nobody writes: Windows keeps others from locked ones

    def locked(file: BinaryIO) -> bool:
        """Lock a file until it is closed; return False if someone else has."""
        at = file.tell()
        file.seek(_BEHIND)
        try:
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined,unused-ignore]
        except OSError:
            return False
        finally:
            file.seek(at)
        return True

else:
    import fcntl

    def locked(file: BinaryIO) -> bool:
        """Lock a file until it is closed; return False if someone else has."""
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return False
        return True
