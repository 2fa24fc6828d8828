"""The league's referee box as data: what it signals, what it is told of the world, in which axes (RefBox 2).

Recordings read and write its logs, the coach gateway speaks with it; nobody else knows the league's axes.
"""
