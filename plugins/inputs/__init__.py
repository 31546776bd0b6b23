"""Input devices: what is plugged in, what it says, what it does, and how it is set up."""
