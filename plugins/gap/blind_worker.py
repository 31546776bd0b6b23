"""The blind test as a separate process, which ends with its own children when it is told to."""

import signal
import sys

from rotemina.app.cli.main import main

if __name__ == "__main__":
    # Interrupted, it takes the diagnosis that it waits for along; terminated, it would not.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    sys.exit(main(["gap", "blind", *sys.argv[1:]]))
