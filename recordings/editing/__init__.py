"""Recordings made of recordings or of messages, and the repair of damaged ones."""
