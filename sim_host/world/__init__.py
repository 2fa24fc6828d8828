"""The physical world; the only package that knows PyBullet."""
