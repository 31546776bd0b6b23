"""What a record says about the machine: frequency response, loop, steps, a fitted model."""
