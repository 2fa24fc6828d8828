"""The match file: its values take effect, and a wrong one is reported with file, key, value and remedy."""

from pathlib import Path

import pytest

from schemas.config.match_config import MatchConfig, load_match
from schemas.errors import TouchlineError
from schemas.side import Side


def test_without_a_file_it_is_five_against_five_of_the_teams_that_ship() -> None:
    match = load_match(None)
    assert match.robots(Side.CYAN) == ["cyan1", "cyan2", "cyan3", "cyan4", "cyan5"]
    assert match.robots(Side.MAGENTA) == ["magenta1", "magenta2", "magenta3", "magenta4", "magenta5"]
    assert match.teams.cyan.brain != match.teams.magenta.brain
    assert match.speed is None


def test_the_name_of_a_shipped_team_is_a_brain(tmp_path: Path) -> None:
    file = tmp_path / "match.toml"
    file.write_text('[teams.cyan]\nbrain = "reference"')
    assert load_match(file).teams.cyan.brain == "robot_agent.teams.reference:Reference"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("sede = 1", 'sede is not known; did you mean "seed"?'),
        ('[teams.cyan]\nbrian = "a:B"', 'teams.cyan.brian is not known; did you mean "brain"?'),
        ("[teams.cyan]\nsize = 12", "teams.cyan.size is 12; a side has 1 to 11 robots"),
        (f"[teams.magenta]\nrobots = {[f'r{n}' for n in range(12)]}", "teams.magenta.robots is"),
        ('[teams.cyan]\nrobots = ["ball"]', 'a robot is named "ball", which has another meaning in keys'),
        ('[teams.cyan]\nrobots = ["magenta1"]', 'two robots are named "magenta1"'),
        ('[teams.cyan]\nbrain = "nonsense"', "teams.cyan.brain is 'nonsense'; write \"module:Class\""),
        ('[teams.cyan]\nbrain = "refrence"', 'or the name of a shipped team; did you mean "reference"?'),
        ('[teams.cyan]\nbrain = "a:B"\ncommand = ["x"]', "a team has one or the other"),
        ('seed = "x"', "seed is 'x'; a whole number"),
        ("seed = true", "seed is True; a whole number"),
        ("duration = true", "duration is True; playing time"),
        ("duration = -5", "duration is -5; playing time"),
        ('pace = "fast"', "pace is 'fast'; write \"lockstep\""),
        ('pace = "x0"', "pace is 'x0'; write \"lockstep\""),
        ('pace = "x0.00"', "pace is 'x0.00'; write \"lockstep\""),
        ('[noise]\npreset = "perfct"', "noise.preset is 'perfct'; one of profile, perfect, paper"),
        ('name = "My Match"', "name is 'My Match'; a match name is a key chunk"),
        ("teams = 3", "teams is 3; write [teams.cyan] and [teams.magenta]"),
        ("[teams]\ncyan = 3", "teams.cyan is 3; write [teams.cyan]"),
        ("scene = 3", "scene is 3; the name of a scene, or a path that ends in .toml"),
        ('[scene]\ndescription = "Mine."', "scene.robots is missing"),
        (
            '[scene]\ndescription = "Mine."\n[[scene.robots]]\nname = "anna"\nside = "blue"',
            "scene.robots.0.side is 'blue'; write cyan or magenta",
        ),
        ("[profile_tables]", 'profile_tables is not for match files; write profile = "FILE.toml"'),
        ("matsch = 1", "known: name, seed, pace, duration, scene, profile, rules, teams, types,"),
        ('[task]\nscre = "a:b"', 'task.scre is not known; did you mean "score"?'),
        ('[teams.cyan]\nsize = 5\nrobots = ["a"]', "teams.cyan.size is 5, and robots names ['a']; leave one out"),
        *(
            (f'scene = "penalty"\n[teams.magenta]\n{key}', f"the scene's robots; leave teams.magenta.{key[:4]}")
            for key in ("size = 1", 'robots = ["a"]', 'types = { magenta1 = "keeper" }')
        ),
        ("obstacles = 3", "obstacles is 3; write [[obstacles]]"),
        (
            "[[obstacles]]\nname = 'a'\nshape = 'box'\nplace = [0, 0]\nsize = [1, 1, 1]\n" * 101,
            "each of at most 100 obst",
        ),
        ('[[obstacles]]\nname = "b"', "obstacles.0.shape is missing; one of cylinder, box"),
        (
            '[[obstacles]]\nname = "b"\nshape = "ball"\nplace = [0, 0]',
            "obstacles.0.shape is 'ball'; one of cylinder, box",
        ),
        ('[[obstacles]]\nname = "b"\nshape = "box"\nplace = [0, 0]\nradius = 1', "a box has size = [x, y, z]"),
        ('[[obstacles]]\nname = "b"\nshape = "box"\nplace = [0, 0]\nsise = [1, 1, 1]', 'did you mean "size"?'),
        (
            '[[obstacles]]\nname = "cyan1"\nshape = "cylinder"\nplace = [0, 0]\nradius = 1\nheight = 1',
            'two bodies are named "cyan1"; every obstacle has a name of its own',
        ),
        (
            'scene = "kick_off"\n[[obstacles]]\nname = "b"\nshape = "box"\nplace = [0, 0]\nsize = [1, 1, 1]',
            "a match that starts in a scene has the scene's obstacles; write these there",
        ),
        ("x =", "not TOML"),
    ],
)
def test_a_wrong_match_file_names_file_key_value_and_remedy(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "cup.toml"
    path.write_text(text)
    with pytest.raises(TouchlineError) as error:
        load_match(path)
    assert str(error.value).startswith(f"{path}: ")
    assert said in str(error.value)
    assert "\n" not in str(error.value)


def test_a_match_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(TouchlineError, match="No such file"):
        load_match(tmp_path / "none.toml")


def test_the_values_of_overrides_are_left_as_they_are() -> None:
    overrides = {"teams.cyan": {"size": 2}, "teams.cyan.size": 3}
    assert load_match(None, overrides).team(Side.CYAN).size == 3
    assert overrides["teams.cyan"] == {"size": 2}


def test_flags_override_the_file_by_the_same_names(tmp_path: Path) -> None:
    path = tmp_path / "cup.toml"
    path.write_text('seed = 3\npace = "realtime"\n[teams.cyan]\nname = "Reds"\nsize = 2\n')
    match = load_match(path, {"seed": 7, "teams.cyan.size": 3})
    assert (match.seed, match.pace, match.speed) == (7, "realtime", 1.0)
    assert match.teams.cyan.name == "Reds"
    assert len(match.robots(Side.CYAN)) == 3


def test_a_scene_may_replace_the_robots_of_a_file(tmp_path: Path) -> None:
    path = tmp_path / "cup.toml"
    path.write_text("[teams.cyan]\nsize = 4\n")
    assert load_match(path, {"scene": "kick_off"}).scene is not None
    with pytest.raises(TouchlineError, match=r"leave teams\.cyan\.size out"):
        load_match(path, {"scene": "kick_off", "teams.cyan.size": 3})


def test_a_team_with_only_a_size_has_the_shipped_brain() -> None:
    assert load_match(None, {"teams.magenta.size": 2}).teams.magenta.brain == load_match(None).teams.magenta.brain


def test_a_team_of_any_program_needs_no_brain(tmp_path: Path) -> None:
    path = tmp_path / "cup.toml"
    path.write_text('[teams.cyan]\ncommand = ["./robot", "--fast"]\n')
    team = load_match(path).teams.cyan
    assert (team.brain, team.command) == (None, ["./robot", "--fast"])


def test_a_match_crosses_to_its_host_as_json_and_is_the_same() -> None:
    match = load_match(None, {"seed": 2**62, "pace": "x4", "noise.preset": "perfect"})
    assert MatchConfig.model_validate_json(match.model_dump_json()) == match
    assert match.speed == 4.0


def test_a_match_holds_its_scene_and_profile_whatever_becomes_of_their_files(tmp_path: Path) -> None:
    scene, profile = tmp_path / "mine.toml", tmp_path / "slow.toml"
    scene.write_text(
        'description = "Mine."\nrules = "msl"\nrobots = [{ name = "anna", side = "cyan", x = 0.0, y = 0.0 }]\n'
    )
    profile.write_text('extends = "msl"\n[drive]\nmax_speed = { value = 1.5, unit = "m/s", origin = "ours" }\n')
    match = load_match(None, {"scene": str(scene), "profile": str(profile)})
    scene.write_text("")
    profile.unlink()
    arrived = MatchConfig.model_validate_json(match.model_dump_json())
    assert arrived == match
    assert (arrived.robots(Side.CYAN), arrived.robots(Side.MAGENTA)) == (["anna"], [])
    assert (arrived.rules, arrived.profile, arrived.load_profile().drive.max_speed) == ("msl", str(profile), 1.5)
    assert arrived.load_profile().origins["drive.max_speed"] == "ours"


def test_files_are_named_from_the_folder_of_the_file_that_names_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "ours"
    folder.mkdir()
    number = '{{ value = {}, unit = "s", origin = "ours" }}'
    (folder / "base.toml").write_text(f'extends = "msl"\n[periods]\nparking = {number.format(3.0)}\n')
    (folder / "short.toml").write_text(f'extends = "base.toml"\n[periods]\nhalf_time_break = {number.format(2.0)}\n')
    (folder / "slow.toml").write_text('extends = "omni"\n')
    scene = (
        'description = "Ours."\nrules = "short.toml"\nrobots = [{ name = "anna", side = "cyan", x = 0.0, y = 0.0 }]\n'
    )
    (folder / "mine.toml").write_text(scene)
    (folder / "match.toml").write_text('rules = "short.toml"\nprofile = "slow.toml"\n')
    (folder / "scene.toml").write_text('scene = "mine.toml"\n')
    monkeypatch.chdir(tmp_path)
    for name in ("match", "scene"):
        book = load_match(f"ours/{name}.toml").load_rule_book()
        assert (book.periods.half_time_break, book.periods.parking) == (2.0, 3.0)
    with pytest.raises(TouchlineError, match=r'rules is "short.toml": No such file'):
        load_match("ours/match.toml", {"rules": "short.toml"})


def test_a_shipped_profile_takes_the_place_of_the_files_profile(tmp_path: Path) -> None:
    (tmp_path / "slow.toml").write_text('extends = "msl"\n')
    path = tmp_path / "cup.toml"
    path.write_text(f'profile = "{tmp_path / "slow.toml"}"\n')
    assert load_match(path).profile_tables is not None
    assert load_match(path, {"profile": "paper"}).profile_tables is None


def test_a_scene_may_stand_in_the_match_file(tmp_path: Path) -> None:
    path = tmp_path / "cup.toml"
    path.write_text(
        '[scene]\ndescription = "Mine."\nprofile = "omni"\n'
        '[[scene.robots]]\nname = "anna"\nside = "cyan"\nx = 0.0\ny = 0.0\n'
    )
    match = load_match(path)
    assert (match.robots(Side.CYAN), match.profile) == (["anna"], "omni")
