"""The sensors of the robots: the true state of the world with counter-based noise."""
