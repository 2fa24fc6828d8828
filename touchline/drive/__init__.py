"""Drives one robot by keys instead of its brain."""
