"""From the name of a brain to a brain: where it is looked for, what can be wrong with it, loading it again."""
