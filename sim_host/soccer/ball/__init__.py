"""Possession, dribbling, kicks, and the motion of the free ball."""
