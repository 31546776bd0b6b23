"""The hot paths of a firmware for the MC68HC11 boards, in assembly, and what they cost the chip."""
