"""Control menu of both stages."""
