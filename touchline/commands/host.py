"""`touchline host`: the simulation alone, for robots and recorders on other machines."""

import tempfile
from pathlib import Path

import typer

from touchline.cli import options
from touchline.cli.option_groups import expand_option_groups


@expand_option_groups
def host(match_options: options.MatchOptions) -> None:
    """Run the simulation host of a match; robots join with `touchline agent`.

    It ends when the match is over, or at Ctrl-C.

    Example: touchline host cup.toml --pace realtime --listen tcp/192.168.1.5:7447 --insecure
    """
    config, endpoint = match_options.read(), match_options.endpoint()
    typer.echo(f'match "{config.name}" on {endpoint}', err=True)

    from sim_host.__main__ import main

    with tempfile.TemporaryDirectory(prefix="touchline-") as folder:
        config_file = Path(folder) / "config.json"
        config_file.write_text(config.model_dump_json(), "utf-8")
        more = ["--insecure"] if match_options.insecure else []
        raise typer.Exit(main(["--listen", endpoint, "--config", str(config_file), *more]))
