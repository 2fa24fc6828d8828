"""The physics engine, its bodies, collisions, and the motion of a free ball; the only package that imports PyBullet."""
