"""End of a half: its playing time is up."""

from schemas.game import EventKind
from sim_host.referee.decision import Decision
from sim_host.referee.restart import reached
from sim_host.referee.scene import Scene


def judge(scene: Scene) -> Decision | None:
    """The end of the half at once, or nothing."""
    state = scene.state
    if not state.clock_runs or not reached(state.clock, state.half_limit):
        return None
    return Decision(
        kind=EventKind.HALF_TIME,
        text=f"half {state.half} ends after {state.clock:.1f} s of play, "
        f"cyan {state.score.cyan} : {state.score.magenta} magenta",
        ends_half=True,
    )
