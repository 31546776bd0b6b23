"""A profile in the words of the protocol."""

from binascii import crc_hqx
from itertools import accumulate

from rotemina.drivers.mc68hc11.axes import BoardAxis
from rotemina.drivers.mc68hc11.message import Message
from rotemina.drivers.mc68hc11.requests import ArmProfile, BeginProfile, Segment
from rotemina.drivers.profile import Profile

_START = 0xFFFF  # of the check, as of the parameters'
_BY_FRAME = 0


def profile_messages(profile: Profile, axis: BoardAxis) -> tuple[Message, ...]:
    """Return what is to be said so that a board has a profile, and waits for its trigger.

    Each segment ends on the step that is nearest to where the profile's does: rounding does not add
    up from one to the next.
    """
    ends = [0, *(axis.steps(at) for at in accumulate(one.length for one in profile.segments))]
    segments = []
    for index, one in enumerate(profile.segments):
        c2, c3 = axis.steps(one.c2), axis.steps(one.c3)
        c1 = ends[index + 1] - ends[index] - c2 - c3
        segments.append(Segment(index, max(1, round(1e6 * one.duration_s)), c1, c2, c3))
    check = crc_hqx(b"".join(one.packed() for one in segments), _START)
    begin = BeginProfile(axis.number, len(segments))
    return (begin, *segments, ArmProfile(_BY_FRAME, check))
