"""Camera contract and built-in cameras."""
