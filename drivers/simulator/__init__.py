"""The built-in simulator as a motion driver."""
