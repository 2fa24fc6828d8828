"""The front door: the command line, and the processes of a match. The only package that may know all others."""
