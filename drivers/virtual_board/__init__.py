"""Virtual boards with a simulated machine.

They are the board's side of the protocol. They take a fifth of a processor core, and the program
another fifth: with six other busy processes on two cores most playbacks end early.
"""
