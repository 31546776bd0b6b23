"""The simulated microscope: what a camera sees of the tip, the pin and a cell."""
