"""Templates of packages with plugins, for ``rotemina plugin new``."""
