"""The boards as a program: the board's side of the protocol, driving the simulated machine."""
