"""What is in a recording, and where two of them differ."""
