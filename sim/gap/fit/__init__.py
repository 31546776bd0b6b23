"""Output-error fits of effects to records, and what they leave of data that they did not see."""
