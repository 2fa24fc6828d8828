"""The protocol page: generated from this code, and its text agrees with the code."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from message_examples import examples
from protocol import page
from protocol_fields import is_part, parts_of, rows, type_text
from runtime.bus.endpoint import DEFAULT_ENDPOINT
from runtime.bus.zenoh import reader, session
from runtime.process.timing import LEASE_S
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.messages.command import Command
from schemas.topics import TOPICS
from schemas.wire.message import BadMessageError, Message
from sim_host.server.admission import agent_stats
from sim_host.timing import RESEND_S
from touchline.launch.processes.process_table import ProcessKind
from touchline.launch.processes.programs import MatchPlan, client_processes
from touchline.launch.processes.supervisor import AFTER_THE_MATCH

MESSAGES = list(dict.fromkeys(kind for row in TOPICS.values() for kind in (row.message, row.reply) if kind is not None))


@pytest.fixture(scope="module")
def text(root: Path) -> str:
    return (root / "docs" / "protocol.md").read_text("utf-8")


def test_the_page_is_fresh(text: str) -> None:
    assert text == page(), "run: .venv/bin/python docs/generate/protocol.py > docs/protocol.md"


def test_every_topic_stands_in_its_table(text: str) -> None:
    for topic in TOPICS.values():
        (row,) = [line for line in text.splitlines() if line.startswith(f"| `{topic.key}` |")]
        assert topic.description in row


@pytest.mark.parametrize("kind", MESSAGES, ids=lambda kind: kind.__name__)
def test_the_example_of_every_message_is_one(
    kind: type[Message], text: str, fenced: Callable[[str, str], list[str]]
) -> None:
    section = text.split(f"\n### {kind.__name__}\n")[1].split("\n### ")[0]
    (example,) = fenced(section, "json")
    again = kind.decode(example.encode()).encode()
    assert json.loads(again) == json.loads(examples()[kind].encode())
    with pytest.raises(BadMessageError):
        kind.decode(json.dumps(json.loads(example) | {"surplus": 1}).encode())


@pytest.mark.parametrize("kind", MESSAGES, ids=lambda kind: kind.__name__)
def test_every_number_of_a_message_has_a_unit_or_a_meaning(kind: type[Message]) -> None:
    waiting, met = [kind], set()
    while waiting:
        part: type = waiting.pop()
        if part in met or not is_part(part):
            continue
        met.add(part)
        waiting.extend(parts_of(part))
        assert [row.name for row in rows(part, str) if row.type.startswith("number") and not row.meaning] == []


def test_limits_and_choices_are_described_in_words() -> None:
    said = {row.name: row.type for row in rows(Command, lambda kind: kind.__name__)}
    assert said["answers_tick"] == "whole number (at least 0)"
    assert said["kick"] == "Kick or null"
    assert type_text(dict[str, list[int]], str) == "text → list of whole number"


def test_the_environment_is_the_one_that_a_robot_is_launched_with(text: str) -> None:
    config = load_match(None, {"teams.cyan.command": ["./robot"]})
    robot = next(
        one
        for one in client_processes(
            MatchPlan(config, DEFAULT_ENDPOINT, Path(), None, launch_token="secret", credentials=Path())
        )
        if one.kind is ProcessKind.AGENT
    )
    said = set(re.findall(r"^\| `(TOUCHLINE_\w+)` \|", text, re.MULTILINE))
    assert said == {name for name in robot.environment if name.startswith("TOUCHLINE_")}
    assert robot.restarts == 3 and "at most three times" in text


def test_the_attachment_is_the_one_that_is_sent(text: str) -> None:
    assert (reader.STAMP.format, reader.STAMP.size) == ("<QQq", 24)
    assert "sends 24 bytes" in text and "| 16–23 | signed |" in text


def test_the_settings_are_those_of_a_client(text: str, fenced: Callable[[str, str], list[str]]) -> None:
    (settings,) = fenced(text, "json5")
    for name, value in session._RETRY.items():
        assert f"{name}: {value}" in settings
    assert f"lease: {round(LEASE_S * 1000)}" in settings


def test_the_times_that_it_names_are_those_of_the_host(text: str) -> None:
    said = " ".join(text.split())
    watchdog = {load_profile(name).safety.watchdog for name in ("msl", "paper")}
    kill = next(
        step.after for step in AFTER_THE_MATCH if ProcessKind.AGENT in step.kinds and step.number.name == "SIGKILL"
    )
    assert watchdog == {0.2} and "(0.2 s of simulated time)" in said
    assert f"SIGKILL {kill:g} s later" in said
    assert f"every {RESEND_S * 1000:g} ms" in said
    assert f"After {agent_stats.SILENT_TICKS} silent ticks in a row" in said
    assert f"longer than {Command.max_bytes} bytes" in said
