"""A match of five a side whose host publishes what a test has it publish, and the page's server before it."""

from collections.abc import Callable
from typing import Any

from schemas.config.match_config import load_match
from schemas.messages.radio import Radio
from schemas.messages.soccer.game import DisciplinaryRecord, RobotQuestion, Score
from schemas.side import Side
from schemas.soccer.game import ActionName, Card, EventKind, OffField, Phase
from schemas.topics import EVENT
from support.fake_host import FakeHost
from support.messages import make_event
from support.visitor import Visitor


class StagedMatch:
    """A match whose host publishes what a test has it publish."""

    def __init__(self, medium: Any, gateway_of: Callable[..., Any]) -> None:
        match = load_match(None, {f"teams.{side}.size": 5 for side in Side} | {"teams.cyan.name": "Lions"})
        self.medium = medium
        self.host = FakeHost(medium, match, in_threads=True)
        self.gateway = gateway_of(medium)
        self.origin = self.gateway.origin
        visitor = Visitor(self.origin)
        visitor.hear_what_is_played()
        for robot in self.host.config.robots(Side.CYAN):
            self.host.believe(robot, Radio(role="striker", intention="shoot"))
        self.host.say(phase=Phase.PLAY, running=True)
        self.host.show()
        visitor.hear("frame")
        visitor.close()

    def propose(self) -> None:
        """The referee proposes a foul, in a long sentence."""
        text = (
            "magenta4 pushed cyan3 0.92 m in its own penalty area, limit 0.50; intent is not judged; "
            "no advantage is played"
        )
        self._propose("pushing", text, Side.MAGENTA, "magenta4")

    def propose_goal(self) -> None:
        """The referee proposes a goal."""
        text = "goal, counts for cyan: ball over the goal line at (11.1, -0.8), 0.11 m high, last touched by cyan3"
        self._propose("goal", text, Side.CYAN, "cyan3")

    def _propose(self, rule: str, text: str, side: Side, robot: str) -> None:
        proposed = f"proposed, decided in 3 s: {text}"
        event = make_event(self.host.state.tick, proposed, EventKind.PROPOSAL, rule=rule, side=side, robot=robot)
        self.host.put(EVENT, event)
        self.host.say(proposal=f"{rule}: {text}")

    def ask_both_sides(self) -> None:
        """A referee box requests a card for each side and names no robot; the proposal still waits."""
        questions = []
        for side in Side:
            robots = self.host.config.robots(side)
            question = RobotQuestion(
                action=ActionName.DOUBLE_YELLOW, side=side, left=8.0, robots=robots, default=robots[-1]
            )
            questions += [question, question]
        self.host.say(questions=questions)

    def show_card(self) -> None:
        """A robot gets a card and leaves the field."""
        away = DisciplinaryRecord(yellow=2, off_field=OffField.SECOND_YELLOW, left=87.0)
        event = make_event(
            self.host.state.tick, "2nd yellow card for magenta4", EventKind.CARD, robot="magenta4", card=Card.YELLOW
        )
        self.host.put(EVENT, event)
        self.host.say(
            proposal=None, questions=[], running=False, phase=Phase.FREE_KICK, side=Side.CYAN, robots={"magenta4": away}
        )

    def score(self) -> None:
        """The tenth goal is scored: the score gets wider."""
        score = Score(cyan=10, magenta=0)
        event = make_event(
            self.host.state.tick, "goal, counts for Lions", EventKind.GOAL, side=Side.CYAN, robot="cyan3", score=score
        )
        self.host.put(EVENT, event)
        self.host.say(phase=Phase.KICK_OFF, side=Side.MAGENTA, left=7.0, score=score)

    def miss_penalty(self) -> None:
        """The first penalty of a shoot-out is missed."""
        tick = self.host.state.tick
        self.host.put(EVENT, make_event(tick, "penalty missed", EventKind.SHOT, side=Side.CYAN, score=Score()))

    def reset(self) -> None:
        """Somebody goes back to the start of the match."""
        self.host.put(EVENT, make_event(self.host.state.tick, "goes back to the start", EventKind.SCENE, rule="reset"))

    def end(self) -> None:
        """Full time."""
        self.host.say(phase=Phase.FULL_TIME, running=False, side=None, left=None)

    def close(self) -> None:
        """End it."""
        self.host.close()
