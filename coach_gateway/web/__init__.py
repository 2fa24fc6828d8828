"""The page's server: sends frames, state and events to any number of browsers, and takes requests by their rights."""
