"""What robots need to play soccer: skills with the ball."""
