"""Records and trajectories, as ASCII files."""
