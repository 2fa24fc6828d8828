"""Estimates with intervals, paired differences, and ratings."""
