"""Teams on a command line: the name of a shipped team, or `module:Class` of any brain."""

from importlib import import_module, resources

from schemas.errors import TouchlineError, did_you_mean


def shipped_teams() -> list[str]:
    """The names of the teams that ship: the packages of `robot_agent.teams`."""
    folders = (resources.files("robot_agent") / "teams").iterdir()
    return sorted(folder.name for folder in folders if (folder / "__init__.py").is_file())


def brain_of(team: str) -> str:
    """`module:Class` of a team: that of the shipped team of this name, or the text itself.

    Raises:
        TouchlineError: no team of this name ships, and it is no `module:Class`.
    """
    if ":" in team:
        return team
    if team not in shipped_teams():
        raise TouchlineError(
            f'team is "{team}"; {did_you_mean(team, shipped_teams())} Or write module:Class, as my_team:Striker'
        )
    package = f"robot_agent.teams.{team}"
    (name,) = (name for name in vars(import_module(package)) if name.lower() == team)
    return f"{package}:{name}"
