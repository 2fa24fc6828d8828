"""The game `free`: robots, obstacles and things to push, without a ball; its task scores it."""
