"""Who may do what, and how much of it: rights, tokens, origins, rate limits. Knows no protocol and no bus."""
