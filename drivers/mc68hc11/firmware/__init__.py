"""Time-critical routines of the firmware of the MC68HC11 boards, in assembly.

The Python modules count the cycles that these routines take on the chip; only the tests use them.

A board needs 242 bytes of the chip's RAM: 30 for the incoming frame, 64 for two outgoing frames, 48
for three axes, 60 for the stack, and 40 for clock, watchdog, frame numbers, state, fault, switches
and the last answer.
"""
