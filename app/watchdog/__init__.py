"""A separate process that reports when the program hangs or dies."""
