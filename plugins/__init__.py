"""The operator's panels, one folder each."""
