"""Coach programs over UDP: JSON datagrams both ways, numbered and acknowledged. Knows the bus, and no physics.

The paper's coach sent datagrams that only one robot could receive; here each order goes to every robot of its side.
"""
