"""The next experiment: safe motions that tell the remaining hypotheses apart."""
