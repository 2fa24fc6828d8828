"""The messages on the bus, one module for each conversation; the topic table says which key carries which."""
