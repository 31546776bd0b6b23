"""Model and real robot in 3-D."""
