"""One robot driven by keys in place of its brain."""
