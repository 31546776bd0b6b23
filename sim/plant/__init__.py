"""The nominal plant, sampled exactly."""
