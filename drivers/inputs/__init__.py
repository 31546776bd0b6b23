"""Input devices behind one contract."""
