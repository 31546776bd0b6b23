"""The robot in three dimensions, model and real as two ghosts."""
