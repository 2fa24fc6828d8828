"""A match in figures, from what its recording holds: numbers for people and programs, and a page to look at.

Pure: moments in, figures out. `moment` joins the messages of one tick, each figure is a file that takes in moment after
moment, `measure` lets all of them do so in one reading. `docs/recordings.md` defines each figure.
"""
