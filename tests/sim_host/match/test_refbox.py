"""A match under a referee box depends on its inputs alone: commands, actions, and whether the box is connected."""

from contextlib import closing

from schemas.config.match_config import load_match
from schemas.game import REFBOX, ActionName
from schemas.messages.command import Command, Drive
from schemas.messages.game import GameState, RefereeAction
from schemas.side import Side
from sim_host.match.simulation import Simulation

Inputs = tuple[tuple[RefereeAction, ...], bool]


def of_box(action: ActionName, side: Side | None = None) -> RefereeAction:
    return RefereeAction(action=action, side=side, source=REFBOX)


SCRIPT: dict[int, RefereeAction] = {
    10: of_box(ActionName.KICK_OFF, Side.MAGENTA),
    200: of_box(ActionName.START),
    260: of_box(ActionName.YELLOW_CARD, Side.CYAN),
    300: RefereeAction(action=ActionName.NAME_ROBOT, robot="cyan2", source="cyan's coach"),
    310: of_box(ActionName.REPAIR, Side.MAGENTA),
}
"""Tick → action; the question about the repair is not answered."""


def played(inputs: list[Inputs]) -> list[tuple[str, GameState]]:
    """The chain and the state of each tick."""
    config = load_match(None, {"duration": 8.0, "referee.mode": "manual", "rules": "msl"})
    with closing(Simulation(config)) as simulation:
        ticks = []
        for actions, refbox in inputs:
            drive = Command(answers_tick=simulation.now.tick, drive=Drive(vx=0.3))
            tick = simulation.step(dict.fromkeys(simulation.roster.names, drive), actions, refbox=refbox)
            assert all(reply.accepted for reply in tick.replies), tick.replies
            assert tick.applied.get("refbox", False) is refbox
            ticks.append((tick.applied["chain"], simulation.state.game_state(tick.tick, tick.time)))
        return ticks


def test_the_same_inputs_give_the_same_match_with_the_same_questions_and_answers() -> None:
    inputs = [((SCRIPT[tick],) if tick in SCRIPT else (), tick < 1000) for tick in range(1600)]
    first, again = played(inputs), played(inputs)
    assert first == again
    states = [state for _, state in first]
    asked = [number for number, state in enumerate(states) if state.questions]
    assert asked == [*range(260, 300), *range(310, 310 + 500)]
    assert states[300].robots["cyan2"].yellow == 1 and states[810].robots["magenta5"].off_field == "repair"
    assert states[1000].half == 1 and states[1000].clock > 4.0
    assert not states[1500].refbox and states[1500].phase != states[1498].phase


def test_the_presence_of_the_box_is_an_input_of_its_own() -> None:
    inputs: list[Inputs] = [((SCRIPT[tick],) if tick in (10, 200) else (), False) for tick in range(500)]
    half_ended = [state.phase for _, state in played(inputs)][-1]
    stays = [state.phase for _, state in played([(actions, True) for actions, _ in inputs])][-1]
    assert half_ended != stays
