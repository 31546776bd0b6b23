"""Records and trajectories: ASCII files of all joints over time."""
