"""What people read of a refusal or an event: plain sentences without names of classes, envelopes or repeated kinds."""

import json
from typing import Any

import pytest

from coach_gateway.match.lines import event_line
from coach_gateway.web.protocol import read_request
from schemas.game import EventKind
from schemas.wire.faults import FaultError
from support.messages import make_event

REFUSED = [
    ({"deed": "order", "side": "cyan", "order": {"mode": "test", "test": "circle"}}, "the test circle needs robot_a"),
    ({"deed": "order", "side": "cyan", "order": {"max_speed": 1000}}, "max_speed is 1000; m/s above 0, at most 20"),
    ({"deed": "action", "action": {"action": "fly"}}, "action is 'fly'; one of start, stop"),
    ({"deed": "drive", "robot": "cyan1", "manual": {"drive": {"vx": "a"}}}, "drive.vx is 'a'; m/s from -20 to 20"),
    ({"deed": "order", "side": "green", "order": {}}, "side is 'green'; one of cyan, magenta"),
    ({"deed": "fly"}, "deed is 'fly'; one of action"),
]


@pytest.mark.parametrize(("content", "sentence"), REFUSED)
def test_a_message_that_cannot_be_read_is_refused_in_a_plain_sentence(content: dict[str, Any], sentence: str) -> None:
    with pytest.raises(FaultError) as refused:
        read_request(json.dumps({"id": 1, **content}))
    assert str(refused.value).startswith(sentence)


def test_an_event_is_one_sentence_that_does_not_repeat_its_kind() -> None:
    goal = make_event(1, "goal, counts for cyan: ball over the goal line", EventKind.GOAL)
    assert event_line(goal) == " 0:00.0  goal: counts for cyan: ball over the goal line"
    assert event_line(make_event(1, "goal by cyan3", EventKind.GOAL)) == " 0:00.0  goal: goal by cyan3"
