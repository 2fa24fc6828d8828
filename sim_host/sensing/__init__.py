"""What robots perceive: truth, plus counter-based noise."""
