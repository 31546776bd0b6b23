"""The operator's log: moves, stops, locks, refusals and runs."""
