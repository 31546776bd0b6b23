"""The panel of faults: those that happened, and those that are put in on purpose."""
