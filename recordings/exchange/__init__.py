"""A match in other people's formats: recordings exported, foreign logs imported; one file or folder for each format."""
