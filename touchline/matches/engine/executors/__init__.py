"""Where matches are played. Each is an executor of `concurrent.futures`, so any other executor does, too."""
