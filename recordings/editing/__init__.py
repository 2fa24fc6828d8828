"""Creates recordings from other recordings or from messages, and repairs damaged ones."""
