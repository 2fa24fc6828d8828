"""What all processes share: configuration, messages, the table of topics, the bus, and the process's clock."""
