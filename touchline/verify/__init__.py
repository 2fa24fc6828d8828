"""Compares a recording with a recomputation: of the world, tick by tick, or of a brain's commands."""
