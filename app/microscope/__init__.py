"""The microscope in the program: calibration, click-to-move and measurements."""
