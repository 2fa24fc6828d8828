"""`touchline credentials`: passwords and certificates for a match on several machines."""

from pathlib import Path
from typing import Annotated

import typer

from runtime.access.certificates import make_certificate
from runtime.access.credentials import HOST_FILE, credential_files, new_credentials, write_credentials
from runtime.bus.settings import ClientSettings
from schemas.errors import TouchlineError
from touchline.commands.cli.option_groups import from_options, with_option_groups

app = typer.Typer(
    no_args_is_help=True,
    help="Make passwords and certificates for a match on several machines.\n\nExample: touchline credentials new --tls",
)


@app.callback()
def credentials() -> None:
    """Keep `new` a command of its own."""


@app.command("new")
@with_option_groups
def new(
    folder: Annotated[Path, typer.Option(help="Folder of the files.")] = Path("credentials"),
    match: Annotated[str | None, typer.Option(help="For this match alone; by default for any match.")] = None,
    connect: Annotated[
        str | None, typer.Option(help="Endpoint of the host, for clients that are given no --connect.")
    ] = None,
    tls: Annotated[bool, typer.Option("--tls", help="Make a certificate, too: connections are encrypted.")] = False,
    host_name: Annotated[
        list[str] | None,
        typer.Option(help="Name or address of the host in its certificate; repeatable. Loopback is always in it."),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the files of earlier credentials.")] = False,
) -> None:
    """Make credentials: a file for the host, and one for each account, which its team, coach or referee gets.

    The files hold passwords; only their owner may read them. The certificate needs every name and address by which
    clients connect to the host.

    Example: touchline credentials new --tls --host-name sim-host.local --host-name 192.168.1.5
    """
    from_options(ClientSettings, match=match, connect=connect)
    if host_name and not tls:
        raise TouchlineError(f"--host-name {host_name[0]} is for a certificate; add --tls")
    existing = [path for path in credential_files(folder) if path.exists()]
    if existing and not force:
        raise TouchlineError(f"{existing[0]} exists; its passwords may be in use; add --force to replace them")
    made = new_credentials(match, make_certificate(host_name or ()) if tls else None)
    try:
        write_credentials(folder, made, connect)
    except OSError as error:
        raise TouchlineError(f"--folder {folder} cannot be written ({error.strerror}); name another folder") from None
    typer.echo(f"host:     touchline host --credentials {folder / HOST_FILE}")
    typer.echo("accounts: give each its own file, and no other")
    for path in credential_files(folder)[1:]:
        typer.echo(f"  {path}")
