"""Languages of the window: one file that Qt reads for each, and what it is made from."""
