"""The fixture `play`, as a user's tests have it."""

from touchline.testing.plugin import play

__all__ = ["play"]
