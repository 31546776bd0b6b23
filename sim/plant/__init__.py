"""The nominal plant: equation of motion, exact sampling, control loop."""
