"""Why a controller cannot be reached, from the bytes that came instead of its answer."""

from rotemina.drivers.gcode.grbl_reports import OLD_STATUS
from rotemina.sim.messages import message

# Wrong baud rates produce bytes above 0x7f and control characters; text has hardly any.
_MIN_TEXT_SHARE = 0.9
_MAX_QUOTED = 60
# No controller says the query itself.
_ECHO_BEFORE_STATUS = b"?<"


def explain_contact(received: bytes, sent: bytes) -> str:
    """Return what arrived on a line without an answer, its likely cause and the remedy.

    Parameters
    ----------
    received : bytes
        Everything that came since the port was opened.
    sent : bytes
        Everything that was sent.
    """
    if not received.strip(b"\0\r\n "):
        return message(
            "engine",
            "nothing arrived; check the controller's power, its cable, and that this is its port",
        )
    text = received.decode("ascii", "replace")
    if _share_of_text(received) < _MIN_TEXT_SHARE:
        return message(
            "engine",
            "{count} bytes arrived that are no text; the baud rate is wrong (GRBL: 115200), or the "
            "line is disturbed",
        ).fill(count=len(received))
    if _is_echo(received, sent):
        return message(
            "engine",
            "what was sent came back and nothing else; turn off the echo of the adapter or modem, "
            "and check that a controller is connected behind it",
        )
    if OLD_STATUS.search(text) or "Grbl 0." in text:
        return message(
            "engine",
            "a controller with GRBL 0.9 or older answered ({reply}); this driver needs GRBL 1.1, "
            "grblHAL or FluidNC: update its firmware",
        ).fill(reply=_quote(text))
    if _ECHO_BEFORE_STATUS in received:
        return message(
            "engine",
            "a controller answers, but the line also returns what is sent ({reply}); turn off the "
            "echo of the adapter or modem",
        ).fill(reply=_quote(text))
    return message(
        "engine",
        "text arrived that is no report of GRBL 1.1, grblHAL or FluidNC ({reply}); check which "
        "device is connected, and the baud rate",
    ).fill(reply=_quote(text))


def _share_of_text(data: bytes) -> float:
    readable = sum(byte in b"\t\r\n" or 0x20 <= byte < 0x7F for byte in data)
    return readable / len(data)


def _is_echo(received: bytes, sent: bytes) -> bool:
    """Return whether everything received was sent before, in this order."""
    echo = bytes(byte for byte in received if byte not in b"\r\n")
    original = bytes(byte for byte in sent if byte not in b"\r\n")
    return bool(echo) and original.startswith(echo)


def _quote(text: str) -> str:
    """Return the first line with anything in it, cut, for a message."""
    line = next((line for line in text.splitlines() if line.strip()), "").strip()
    return repr(line if len(line) <= _MAX_QUOTED else f"{line[:_MAX_QUOTED]}…")
