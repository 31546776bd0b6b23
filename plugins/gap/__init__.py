"""Gap diagnosis and correction."""
