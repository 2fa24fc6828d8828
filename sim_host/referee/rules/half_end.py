"""End of a half: its playing time is up.

Section: match.
Measures: the game clock, which runs from the first START of a half on, also through stoppages.
Not judged: lost time, which nobody adds.
"""

from schemas.game import EventKind
from sim_host.referee.decision import Decision
from sim_host.referee.scene import Scene
from sim_host.referee.timing import reached


def judge(scene: Scene) -> Decision | None:
    """The end of the half at once, or nothing."""
    state = scene.state
    if not state.timing.runs or not reached(state.clock, state.timing.limit):
        return None
    return Decision(
        kind=EventKind.HALF_TIME,
        text=f"half {state.half} ends after {state.clock:.1f} s of play, "
        f"cyan {state.score.cyan} : {state.score.magenta} magenta",
        ends_half=True,
    )
