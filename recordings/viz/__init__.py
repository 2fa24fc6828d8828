"""A match drawn for viewers: messages of `foxglove.*`, derived from the messages of the host alone."""
