"""Files that the program carries: robots, example trajectories, theme, icons."""
