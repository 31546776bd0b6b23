"""Explanation why a controller does not answer, from the bytes that arrived instead."""

from rotemina.drivers.gcode.grbl_reports import OLD_STATUS_PATTERN
from rotemina.sim.messages import message

# A wrong baud rate produces many bytes above 0x7f and control characters. Text has hardly any.
_MIN_READABLE_FRACTION = 0.9
_MAX_QUOTE_CHARS = 60
# No controller sends the query character "?" itself, so it is an echo of the query.
_ECHO_BEFORE_STATUS = b"?<"


def explain_no_answer(received: bytes, sent: bytes) -> str:
    """Return a text that states what arrived instead of an answer, the likely cause and the remedy.

    Parameters
    ----------
    received : bytes
        The first bytes that arrived after the port was opened.
    sent : bytes
        The first bytes that were sent.
    """
    if not received.strip(b"\0\r\n "):
        return message(
            "engine",
            "nothing arrived; check the controller's power, its cable, and that this is its port",
        )
    text = received.decode("ascii", "replace")
    if _compute_readable_fraction(received) < _MIN_READABLE_FRACTION:
        return message(
            "engine",
            "{count} bytes arrived that are not text; the baud rate is wrong (GRBL: 115200), or "
            "there is interference on the line",
        ).fill(count=len(received))
    if _is_echo(received, sent):
        return message(
            "engine",
            "only an echo of the sent bytes arrived; turn off the echo of the adapter or modem, "
            "and check that a controller is connected to it",
        )
    if OLD_STATUS_PATTERN.search(text) or "Grbl 0." in text:
        return message(
            "engine",
            "a controller with GRBL 0.9 or older answered ({reply}); this driver needs GRBL 1.1, "
            "grblHAL or FluidNC: update its firmware",
        ).fill(reply=_quote(text))
    if _ECHO_BEFORE_STATUS in received:
        return message(
            "engine",
            "a controller answers, but the line also echoes the sent bytes ({reply}); turn off the "
            "echo of the adapter or modem",
        ).fill(reply=_quote(text))
    return message(
        "engine",
        "text arrived that is not a report of GRBL 1.1, grblHAL or FluidNC ({reply}); check which "
        "device is connected, and the baud rate",
    ).fill(reply=_quote(text))


def _compute_readable_fraction(data: bytes) -> float:
    readable_count = sum(byte in b"\t\r\n" or 0x20 <= byte < 0x7F for byte in data)
    return readable_count / len(data)


def _is_echo(received: bytes, sent: bytes) -> bool:
    """Return whether the received bytes repeat the first sent bytes, apart from line ends."""
    echo = bytes(byte for byte in received if byte not in b"\r\n")
    original = bytes(byte for byte in sent if byte not in b"\r\n")
    return bool(echo) and original.startswith(echo)


def _quote(text: str) -> str:
    """Return the first line that is not blank, shortened for a message."""
    line = next((line for line in text.splitlines() if line.strip()), "").strip()
    return repr(line if len(line) <= _MAX_QUOTE_CHARS else f"{line[:_MAX_QUOTE_CHARS]}…")
