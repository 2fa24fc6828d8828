"""Rigs that tests share: hosts, worlds, referees, recorders and programs, and builders of messages."""
