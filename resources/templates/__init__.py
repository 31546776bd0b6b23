"""Templates for ``rotemina plugin new``."""
