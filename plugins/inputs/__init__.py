"""Input devices and their set-up."""
