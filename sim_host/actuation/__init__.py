"""What the robots' commands do to the bodies: drive, dribble, kick."""
