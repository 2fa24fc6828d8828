"""The sensors that robots carry besides their camera: one file a kind, with its numbers and its reading."""
