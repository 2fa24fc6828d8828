"""The page's server: frames, state and events out to any number of browsers, commands in from those that may."""
