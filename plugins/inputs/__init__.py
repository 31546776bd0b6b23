"""Input devices: connected ones, their readings, their functions, and their set-up."""
