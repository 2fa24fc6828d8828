"""Where the ball and the robots are set down: restart spots, legal positions, clear ground, the bench."""
