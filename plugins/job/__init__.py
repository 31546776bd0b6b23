"""The running job, its progress, and its pause and stop buttons."""
