"""The variant that shows what collaboration is worth: the same team with its radios off."""

import msgspec

from robot_agent.contract import Briefing
from robot_agent.teams.reference import Reference, WithoutRadio

PLACES = {"cyan2": (-3.0, 0.0, 0.0), "cyan3": (-2.0, 3.0, 0.0), "magenta1": (11.0, 0.0, 3.14)}


def test_robots_without_radio_neither_send_nor_use_what_they_receive(scene, setup, monkeypatch):
    sights = []
    act = Reference.act
    monkeypatch.setattr(Reference, "act", lambda robot, sight: (sights.append(sight), act(robot, sight))[1])
    scene(PLACES, (0.0, 0.0)).play(1.0)
    monkeypatch.undo()
    received = [sight for sight in sights if "cyan3" in sight.radio]
    deaf, alone = (WithoutRadio(Briefing.of("cyan2", setup)) for _ in range(2))
    answers = [(deaf.act(sight), alone.act(msgspec.structs.replace(sight, radio={}))) for sight in received]
    assert len(answers) > 20
    assert all(one == other and one.radio is None for one, other in answers)
