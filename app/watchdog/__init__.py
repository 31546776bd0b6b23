"""A process beside the program that tells when the program hangs or has died."""
