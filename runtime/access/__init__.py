"""Access to the bus: accounts, what each may do by the topic table, credentials and certificates. Knows no bus."""
