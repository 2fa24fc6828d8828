"""Access control: roles, rights, tokens, origins, rate limits. Knows no protocol and no bus."""
