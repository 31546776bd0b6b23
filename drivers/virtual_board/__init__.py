"""Virtual boards: the board's side of the protocol, driving the simulated machine."""
