"""`touchline host`: the simulation alone, for robots and recorders on other machines."""

import tempfile
from pathlib import Path

import typer

from arena import options


def host(
    file: options.MatchFile = None,
    seed: options.Seed = None,
    pace: options.Pace = None,
    duration: options.Duration = None,
    scene: options.Scene = None,
    profile: options.Profile = None,
    rules: options.Rules = None,
    referee: options.Referee = None,
    name: options.MatchName = None,
    listen: options.Listen = options.DEFAULT_ENDPOINT,
    insecure: options.Insecure = False,
) -> None:
    """Run the simulation host of a match; robots join with `touchline agent`.

    It ends when the match is over, or at Ctrl-C.

    Example: touchline host cup.toml --pace realtime --listen tcp/192.168.1.5:7447 --insecure
    """
    config = options.read_match(
        file,
        seed=seed,
        pace=pace,
        duration=duration,
        scene=scene,
        profile=profile,
        rules=rules,
        name=name,
        referee__mode=referee,
    )
    endpoint = options.listening(listen, insecure=insecure)
    typer.echo(f'match "{config.name}" on {endpoint}', err=True)

    from sim_host.__main__ import main

    with tempfile.TemporaryDirectory(prefix="touchline-") as folder:
        config_file = Path(folder) / "config.json"
        config_file.write_text(config.model_dump_json(), "utf-8")
        more = ["--insecure"] if insecure else []
        raise typer.Exit(main(["--listen", endpoint, "--config", str(config_file), *more]))
