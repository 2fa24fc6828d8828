"""Tests of TeamName: each plays a scene in this process, without a network."""
