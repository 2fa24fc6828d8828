"""The teams that ship."""
