"""Recordings of robots on hardware: played as hardware, and searched for the numbers of a robot."""
