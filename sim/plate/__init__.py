"""The plate that holds the pin, by finite elements."""
