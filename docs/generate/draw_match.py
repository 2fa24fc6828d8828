"""Draws a recorded match: `python docs/generate/draw_match.py RECORDING PICTURE [SECOND …]`, one panel for each second.

Seconds are simulated time; without any, the last moment of play is drawn. `docs/images/match.png` was drawn from a
recording of `touchline match --seed 7 --duration 120`.
"""

import sys
from pathlib import Path

from recordings.picture import draw
from schemas.errors import TouchlineError

if __name__ == "__main__":
    try:
        recording, picture, *seconds = sys.argv[1:]
        draw(Path(recording), Path(picture), [float(second) for second in seconds] or None)
    except TouchlineError as error:
        sys.exit(str(error))
    except ValueError:
        sys.exit(str(__doc__))
