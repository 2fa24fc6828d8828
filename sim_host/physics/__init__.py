"""The engine, its bodies and the laws of motion of a free ball; the only package that knows PyBullet."""
