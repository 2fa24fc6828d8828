"""The game `free`: robots, obstacles, things to push and zones; its score is a function of the user."""
