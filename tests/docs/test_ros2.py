"""The commands of docs/ros2.md run, and its table is the graph that others list."""

import json
import re
import shlex
import subprocess
import sys
import time
from contextlib import ExitStack
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from schemas.config.match_config import load_match
from support.recorded_match import record_match
from support.ros_match import LIMIT_S, TEAM, graph_at, said_in, started, touchline

pytestmark = [
    pytest.mark.skipif(None in map(find_spec, ("xxhash", "zenoh_ros2_sdk")), reason="needs xxhash and zenoh_ros2_sdk"),
    pytest.mark.processes,
    pytest.mark.slow,
]

PAGE = (Path(__file__).parents[2] / "docs" / "ros2.md").read_text("utf-8")
FREE = ("--listen", "tcp/127.0.0.1:0")
ROBOTS = [f"cyan{number}" for number in range(1, 6)]


def commands_below(heading: str) -> list[list[str]]:
    """The words of the commands in the shell block below a heading."""
    section = PAGE.partition(f"\n## {heading}\n")[2]
    block = re.search(r"```sh\n(.*?)```", section, re.DOTALL)
    assert block is not None
    return [shlex.split(line, comments=True)[1:] for line in block[1].splitlines()]


def listed(at: str, last: str) -> dict[str, Any]:
    """The graph, as the SDK lists it, once the topic or service that comes last is there."""
    words = [sys.executable, "-W", "ignore", str(TEAM), "list", at]
    found: dict[str, Any] = {"topics": {}, "services": {}}
    deadline = time.monotonic() + LIMIT_S
    while last not in found["topics"] | found["services"]:
        assert time.monotonic() < deadline, found
        run = subprocess.run(words, capture_output=True, text=True, timeout=LIMIT_S, check=True)
        found = json.loads(run.stdout)
    return found


def test_the_commands_for_nodes_play_a_match_and_the_table_is_their_graph(tmp_path: Path) -> None:
    match, ros2 = commands_below("Nodes that drive robots")
    with ExitStack() as stack:
        words = touchline(*match, "--duration", "2", "--name", "page", "--rules", "friendly", "--no-record", *FREE)
        log = stack.enter_context(started(words, tmp_path, "match"))
        said_in(log, "(waiting for cyan)")
        at = graph_at(stack.enter_context(started(touchline(*ros2, "--match", "page", *FREE), tmp_path, "ros2")))
        graph = listed(at, f"/{ROBOTS[-1]}/kick")
        stack.enter_context(started([sys.executable, "-W", "ignore", str(TEAM), "sdk", at, *ROBOTS], tmp_path, "team"))
        said_in(log, "(full time)")
    rows = re.findall(r"^\| `/(\S+)`(?: \*\*(in|service)\*\*)? \| (.*?) \|", PAGE, re.MULTILINE)
    assert len(rows) == 12
    for name, way, types in rows:
        package = ""
        of = graph["services" if way == "service" else "topics"]
        for written in re.findall(r"`([\w/]+)`", types):
            package, _, short = written.rpartition("/") if "/" in written else (package, "", written)
            kind = "srv" if way == "service" else "msg"
            if name != "<robot>/scan":  # the robots of this match have no range finder
                assert f"{package}/{kind}/{short}" in of[f"/{name.replace('<robot>', 'cyan1')}"], name
    told = {topic for topic in graph["topics"] if not topic.startswith(tuple(f"/{robot}/" for robot in ROBOTS[1:]))}
    assert {topic.replace("/cyan1/", "/<robot>/") for topic in told} == {
        f"/{name}" for name, way, _ in rows if way != "service" and name != "<robot>/scan"
    }


def test_the_commands_for_control_serve_what_their_table_lists(tmp_path: Path) -> None:
    match, ros2 = commands_below("Pause, step and change a match")
    with ExitStack() as stack:
        words = touchline(*match, "--name", "page_control", "--pace", "realtime", "--no-record", *FREE)
        said_in(stack.enter_context(started(words, tmp_path, "match")), "(kick-off)")
        words = touchline(*ros2, "--match", "page_control", *FREE)
        at = graph_at(stack.enter_context(started(words, tmp_path, "ros2")))
        graph = listed(at, "/touchline/step_simulation")
    section = PAGE.partition("\n## Pause, step and change a match\n")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| (`\w+`.*?) \|", section, re.MULTILINE)
    written = {name for row in rows for name in re.findall(r"`(\w+)`", row)}
    served = {name.removeprefix("/touchline/") for name in graph["services"] if name.startswith("/touchline/")}
    assert served == (written - {"simulate_steps"}) | {
        f"simulate_steps/_action/{part}" for part in ("send_goal", "cancel_goal", "get_result")
    }


def test_the_commands_for_a_recording_show_it(tmp_path: Path) -> None:
    replay, ros2 = commands_below("A match or a recording as a graph")
    team = {"size": 1, "brain": "robot_agent.teams.simple:Simple"}
    config = load_match(None, {"name": "page_replay", "teams.cyan": team, "teams.magenta": team})
    record_match(tmp_path / "RECORDING.mcap", config, until=1.0)
    with ExitStack() as stack:
        log = stack.enter_context(started(touchline(*replay, *FREE), tmp_path, "replay"))
        said_in(log, r"(match \"page_replay\" on)")
        words = touchline(*ros2, "--match", "page_replay", *FREE)
        at = graph_at(stack.enter_context(started(words, tmp_path, "ros2")))
        found = listed(at, "/cyan1/odom")
    kinds = {"/clock": "rosgraph_msgs/msg/Clock", "/tf": "tf2_msgs/msg/TFMessage", "/game/state": "std_msgs/msg/String"}
    for topic, kind in (kinds | {"/cyan1/odom": "nav_msgs/msg/Odometry"}).items():
        assert found["topics"][topic] == [kind]
    (clock_publisher,) = found["clock"]
    assert (clock_publisher["node_name"], clock_publisher["qos"]) == ("touchline", "2::,1:,:,:,,")


def test_the_commands_for_accounts_open_a_graph_for_them(tmp_path: Path) -> None:
    make, ros2 = commands_below("Who may join")
    subprocess.run(touchline(*make), cwd=tmp_path, check=True, capture_output=True, timeout=LIMIT_S)
    ros2[ros2.index("--listen") + 1] = FREE[1]
    with ExitStack() as stack:
        words = touchline("match", "--remote", "cyan", "--name", "page_accounts", "--no-record", *FREE)
        said_in(stack.enter_context(started(words, tmp_path, "match")), "(waiting for cyan)")
        said = stack.enter_context(started(touchline(*ros2, "--match", "page_accounts"), tmp_path, "ros2"))
        assert graph_at(said)
