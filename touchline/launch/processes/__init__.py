"""The processes of a match: which there are, how each is started, watched and ended."""
