"""Records as they come: clocks, units, dead sensors, duplicates, leaps of time."""
