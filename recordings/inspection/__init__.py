"""Facts of a recording, and the first difference of two recordings."""
