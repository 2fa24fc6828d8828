"""The table of all commands, each in a file of its own under `commands/`, which is imported when its command is run."""

from collections import UserDict
from importlib import import_module
from typing import Any

import typer

from touchline.commands.cli.errors import CommandGroup

PANELS = {
    "Play": ("match",),
    "Build a team": ("new", "check", "drill", "task", "series", "tournament", "experiment", "identify"),
    "Watch": ("watch", "health", "replay"),
    "Processes on several machines": ("host", "agent", "team", "ros2", "record", "credentials"),
    "Recordings": ("info", "stats", "verify", "diff", "filter", "recover", "export", "import"),
    "Protocol": ("topics",),
    "Operate a running match": ("coach", "referee", "scene", "parameters", "pace"),
}
"""The commands by their place in `touchline --help`."""

MODULES = {"import": "import_log"}
"""Commands whose name no module can have."""


class TouchlineGroup(CommandGroup):
    """All commands of the table. An import of each takes longer than most commands run."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self.commands = Commands({name: panel for panel, names in PANELS.items() for name in names})


class Commands(UserDict[str, Any]):
    """Commands by name, given their panel; each is imported when it is looked up."""

    def __getitem__(self, name: str) -> Any:
        found = super().__getitem__(name)
        if isinstance(found, str):
            found = self[name] = _command(name, panel=found)
        return found


def _command(name: str, panel: str) -> Any:
    """The command of a module: its app, or its function of the module's name."""
    module_name = MODULES.get(name, name)
    module = import_module(f"touchline.commands.{module_name}")
    app = typer.Typer(add_completion=False)
    if not hasattr(module, "app"):
        app.command(name, rich_help_panel=panel)(getattr(module, module_name))
        return typer.main.get_command(app)
    app.add_typer(module.app, name=name, rich_help_panel=panel)
    group: Any = typer.main.get_command(app)
    return group.commands[name]
