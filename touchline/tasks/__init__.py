"""The tasks that ship: of each a match file with its scene, and a module with its score and its baseline brain."""
