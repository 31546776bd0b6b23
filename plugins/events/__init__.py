"""The operator's log: moves, stops, refusals."""
