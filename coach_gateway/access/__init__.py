"""Access control: roles, rights, tokens, origins, counts of refusals. Knows no protocol and no bus."""
