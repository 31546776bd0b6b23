"""Why nothing moves, in the words that an operator reads, with what to do."""

from rotemina.app.motion.state import Connection, SessionState

NOT_CONNECTED = "not connected; connect first"
_NOT_YET = "the position is not known yet"


def lock_reason(state: SessionState, doubt: str | None) -> str | None:
    """Return why no motion is possible by a state, and by a doubt about the position; else None."""
    if state.connection is Connection.FAILED:
        return f"the device failed ({state.fault}); reconnect, then check where it stands"
    if state.connection is not Connection.CONNECTED:
        return NOT_CONNECTED
    if state.fault is not None:
        return f"the device reports a fault ({state.fault}); clear it first"
    if state.silent_s > 0.0:
        return "the device does not answer; wait until it does"
    if state.differences:
        return (
            f"the device's parameters are not those of the robot file ({state.differences[0]}); "
            "write or accept them first"
        )
    if not state.position_known:
        which = f" of {', '.join(state.unhomed)}" if state.unhomed else ""
        return f"the position{which} is not known; home first" if which else _NOT_YET
    if doubt is not None:
        return f"{doubt}: the position may be wrong; home, or confirm it"
    return None
