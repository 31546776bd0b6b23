"""Reasons why motion is locked, with remedies, in the operator's words."""

from rotemina.app.motion.state import Connection, SessionState
from rotemina.sim.messages import message

NOT_CONNECTED = message("engine", "not connected; connect first")


def lock_reason(state: SessionState, doubt: str | None) -> str | None:
    """Return why no motion is possible by a state, and by a doubt about the position; else None."""
    if state.connection is Connection.FAILED:
        return message(
            "engine", "the device failed ({fault}); reconnect, then check its position"
        ).fill(fault=state.fault or "")
    if state.connection is not Connection.CONNECTED:
        return NOT_CONNECTED
    if state.fault is not None:
        return message("engine", "the device reports a fault ({fault}); clear it first").fill(
            fault=state.fault or ""
        )
    if state.silent_s > 0.0:
        return message("engine", "the device does not answer; wait until it does")
    if state.differences:
        return message(
            "engine",
            "the device's parameters differ from the robot file ({difference}); write or "
            "accept them first",
        ).fill(difference=state.differences[0])
    if not state.position_known:
        if not state.unhomed:
            return message("engine", "the position is not known yet")
        unknown = message("engine", "the position of {axes} is not known; home first")
        return unknown.fill(axes=", ".join(state.unhomed))
    if doubt is not None:
        return message("engine", "{reason}: the position may be wrong; home, or confirm it").fill(
            reason=doubt
        )
    return None
