"""Data formats of RefBox 2, the referee box of the Middle Size League: signals, world states, and their axes.

Recordings read and write its logs, and the coach gateway exchanges messages with it; no other code uses these axes.
"""
