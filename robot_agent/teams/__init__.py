"""The shipped teams."""
