"""Coach programs over UDP: JSON datagrams both ways, numbered and acknowledged. Knows the bus, no physics.

The paper's coach sent datagrams that one robot alone could take; here each order goes to every robot of its side.
"""

DEFAULT_PORT = 28090
"""Ours; the league's ports begin at 28097."""
