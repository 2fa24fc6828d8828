"""Statistics of a match, from its recording: figures for people and programs, and a page for the browser.

Without side effects: `match_tick` joins the messages of one tick, each figure has a module with a class that is updated
tick by tick, `match_statistics` updates all of them in one pass. `docs/recordings.md` defines each figure.
"""
