"""Reads recordings: finished files, files that are still growing, and the ticks of a match."""
