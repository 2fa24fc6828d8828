"""The league's referee box as data: what it signals, what it is told of the world, in which axes (reference 9).

Recordings read and write its logs, the coach gateway speaks with it; nobody else knows the league's axes.
"""
