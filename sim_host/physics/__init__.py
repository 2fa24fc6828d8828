"""The physics engine, its bodies, collisions, and the bounce of a ball; the only package that imports PyBullet."""
