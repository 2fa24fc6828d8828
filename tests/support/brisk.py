"""A rule book for matches that only have to be played to their end."""

from pathlib import Path

BRISK = Path(__file__).with_name("brisk.toml")
