"""A robot's own body: what its hardware implements, and what stands between that and a brain."""
