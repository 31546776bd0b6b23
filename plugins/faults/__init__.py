"""Past faults, and fault injection for training."""
