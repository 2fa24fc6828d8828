"""Ten minutes of soccer, five against five by the rules of the league: its score."""

from touchline import Moment


def difference(now: Moment) -> float:
    """Goals of cyan minus goals of magenta."""
    return float(now.game.score.cyan - now.game.score.magenta)
