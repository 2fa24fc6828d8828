"""Drills: scenes with an end and a verdict, played from many seeds."""
