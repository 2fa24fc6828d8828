"""A match in figures, from what its recording holds: numbers for people and programs, and a page to look at.

Pure: ticks in, figures out. `match_tick` joins the messages of one tick, each figure is a file that is updated tick by
tick, `match_statistics` updates all of them in one reading. `docs/recordings.md` defines each figure.
"""
