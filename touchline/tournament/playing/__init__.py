"""Plays the matches of a cup, each in a process of its own, and stores how each ended."""
