"""Firmware hot paths in assembly.

They are for the MC68HC11 boards; modules count what they cost the chip.

A board takes 242 bytes of the chip's RAM: the incoming frame 30, two outgoing frames 64, three axes
48, clock, watchdog, numbers, state, fault, switches and the last answer 40, and the stack 60.
"""
