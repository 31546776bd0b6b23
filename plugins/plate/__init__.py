"""The holding plate in 3-D: stress, deformation and modes over the range of motion."""
