"""Examination of this machine and of the way to a host: what works, what does not, and what to do."""
