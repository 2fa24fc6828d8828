"""The places of the ball and the robots: restart spots, legal positions, clear ground, the bench."""
