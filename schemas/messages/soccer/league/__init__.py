"""Data formats of the Middle Size League's referee box: its signals, its world states, and their axes.

Recordings read and write its logs, and the coach gateway exchanges messages with it; no other code uses these axes.
"""
