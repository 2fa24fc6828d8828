"""Reads recordings: whole, by a cursor while they grow, or tick by tick."""
