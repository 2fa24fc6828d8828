"""Robots on hardware as processes: in the match of a host, and with hardware and brains that fail."""

import os
import re
import signal

import pytest

from robot_agent.process.settings import AgentSettings, BodyOptions
from runtime.bus.endpoint import with_free_port
from schemas.config.match_config import MatchConfig
from schemas.topics import HARDWARE
from sim_host.server.settings import HostSettings
from support.process_story import LIMIT, descendants, wait_for
from support.visitor import Visitor

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

CODE = """
import signal, time
from robot_agent.hardware.dummy import Dummy
from touchline import Command, Drive, Radio

class Circling:
    def __init__(self, briefing):
        self.asked = 0

    def act(self, sight):
        self.asked += 1
        return Command(answers_tick=sight.tick, drive=Drive(vx=0.5, omega=0.5))

class Blocking(Circling):
    def act(self, sight):
        if self.asked == 20:
            print("blocks", flush=True)
            time.sleep(3600.0)
        return super().act(sight)

class Talking(Circling):
    def act(self, sight):
        for mate, heard in sight.radio.items():
            if self.asked >= 0:
                print(f"{sight.robot} hears {mate} at {heard.self.x:g}", flush=True)
                self.asked = -1000000
        return Command(answers_tick=sight.tick, radio=Radio(self=sight.self))

class Noted(Dummy):
    def actuate(self, drive, kick, dribble):
        if self.drive is not None and self.drive.vx and not (drive and drive.vx):
            print("at rest", flush=True)
        super().actuate(drive, kick, dribble)

class Hanging(Noted):
    def sense(self, time_):
        if time_ > 1.0:
            self.block()
        return super().sense(time_)

    def block(self):
        time.sleep(3600.0)

class Stubborn(Hanging):
    def block(self):
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        time.sleep(3600.0)

class Loose(Noted):
    def actuate(self, drive, kick, dribble):
        if self.kicks or drive.vx > 0.2:
            raise OSError("the cable is out")
        super().actuate(drive, kick, dribble)
"""
TEAMS = {"cyan": {"robots": ["cyan1"]}, "magenta": {"robots": ["magenta1"]}}


def settings(robot="cyan1", brain="code:Circling", hardware="code:Noted", **more):
    body = {"hardware": hardware, "arm": True, **more.pop("body", {})}
    return AgentSettings(robot=robot, brain=brain, body=BodyOptions(**body), **more)


@pytest.fixture(scope="module")
def place(folder):
    (folder / "code.py").write_text(CODE)
    (folder / "match.toml").write_text("")
    (folder / "patient.toml").write_text('hardware = "simulated"\nwatchdog = 2.0  # on a busy machine\n')
    return folder


@pytest.fixture
def alone(start, place):
    """Starts a robot without a host; its name is that of its files."""

    def run(name, **more):
        body = {"match_file": "match.toml", "listen": with_free_port("tcp/127.0.0.1:0")}
        return start("robot_agent", folder=place, name=name, settings=settings(body=body, **more))

    return run


def test_a_robot_on_hardware_plays_the_match_of_a_host_which_goes_on_when_its_board_dies(
    start, listen, place, endpoint
):
    match = {"name": "mixed", "seed": 7, "duration": 3000, "pace": "realtime", "teams": TEAMS}
    host_settings = HostSettings(listen=endpoint, config=MatchConfig.model_validate(match))
    host = start("sim_host", folder=place, name="host", settings=host_settings)
    joined = {"connect": endpoint, "match": "mixed", "patience": 60}
    robot = start("robot_agent", folder=place, name="robot", settings=settings(hardware="patient.toml", **joined))
    other = AgentSettings(robot="magenta1", brain="code:Circling", **joined)
    start("robot_agent", folder=place, name="other", settings=other)
    heard = listen("mixed", endpoint, host)
    reports = heard.bus.subscribe(HARDWARE, history=True)
    heard.until_tick(100)
    heard.until(lambda one: one.healths and one.healths[-1].robots["cyan1"].answers > 50, "answers")
    assert {name for name, one in heard.healths[-1].robots.items() if one.alive} == {"cyan1", "magenta1"}
    assert wait_for(reports.receive, "a report of the hardware").message().state == "active"
    (board,) = descendants(robot.popen.pid)

    os.kill(board, signal.SIGKILL)
    assert robot.status() == 1
    assert "cyan1: the hardware has failed: " in robot.err
    heard.until(lambda one: not one.healths[-1].robots["cyan1"].alive, "the robot to be gone")
    heard.for_ticks(50)


def test_a_brain_that_blocks_lets_the_robot_fall_back(alone):
    robot = alone("blocking", brain="code:Blocking")
    wait_for(lambda: "at rest" in robot.out, f"rest; {robot.out} {robot.err}")
    assert "blocks" in robot.out and "cyan1: no demand for 0.2 s: brake" in robot.err


def test_teammates_without_a_host_hear_each_other_over_the_network(start, place):
    endpoint = with_free_port("tcp/127.0.0.1:0")
    ways = {"cyan1": {"body": {"match_file": "match.toml", "listen": endpoint}}}
    ways["cyan2"] = {"body": {"match_file": "match.toml"}, "connect": endpoint, "patience": 60}
    robots = {
        name: start("robot_agent", folder=place, name=name, settings=settings(name, "code:Talking", **way))
        for name, way in ways.items()
    }
    for name, mate in (("cyan1", "cyan2"), ("cyan2", "cyan1")):
        wait_for(lambda name=name: " hears " in robots[name].out, f"{name} to hear; {robots[name].err}")
        assert robots[name].out == f"{name} hears {mate} at 0\n"
    for robot in robots.values():
        robot.popen.send_signal(signal.SIGTERM)
        assert robot.status() == 0


def test_a_page_without_a_host_officiates_robots_on_hardware(start, place):
    (place / "officiated.toml").write_text('[referee]\nmode = "manual"\n')
    endpoint = with_free_port("tcp/127.0.0.1:0")
    words = ("--match-file", "officiated.toml", "--listen", endpoint, "--port", "0")
    gateway = start("touchline", "coach", "serve", *words, folder=place, name="gateway")
    body = {"match_file": "officiated.toml"}
    robot = start(
        "robot_agent", folder=place, name="obeys", settings=settings(body=body, connect=endpoint, patience=60)
    )
    wait_for(lambda: "the game is that of a gateway" in robot.err, "the game")
    origin, token = wait_for(lambda: re.search(r"referee: (\S+)/#token=(\S+)", gateway.out), "the page").groups()
    page = Visitor(origin, token, patience=LIMIT)
    page.hear_what_is_played()
    assert page.ask("action", action={"action": "start"})["accepted"]
    while page.hear("state")["state"]["phase"] != "play":
        pass
    page.socket.close()
    for program in (robot, gateway):
        program.popen.send_signal(signal.SIGTERM)
        assert program.status() == 0


@pytest.mark.parametrize("hardware", ["Hanging", "Stubborn"])
def test_hardware_that_does_not_return_is_named_and_ends_the_process(alone, hardware):
    robot = alone(hardware.lower(), hardware=f"code:{hardware}")
    assert robot.status() == 1
    assert "cyan1: the hardware has failed: sense has not returned for 0.2 s" in robot.err


def test_hardware_that_raises_is_named_once_and_ends_the_process(alone):
    robot = alone("loose", hardware="code:Loose")
    assert robot.status() == 1
    assert robot.err.count("the cable is out") == 2, robot.err  # when it failed, and why the process ends


@pytest.mark.parametrize(
    ("hardware", "said"),
    [
        ("nothing", "name a class, module:Class, a file *.toml, or dummy, simulated, replayed"),
        ("code:Nothing", "code has no Nothing"),
        ("missing.toml", "missing.toml: No such file or directory; give the path of a hardware file"),
        ("code:CODE", "code has no CODE"),
    ],
)
def test_hardware_that_is_not_there_is_one_line(alone, hardware, said):
    robot = alone(f"wrong_{hardware.replace(':', '_')}", hardware=hardware)
    assert robot.status() == 2
    where, fault = robot.err.splitlines()
    assert where.startswith("cyan1: match friendly without a host, at tcp/127.0.0.1:") and said in fault
