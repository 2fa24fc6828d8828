"""The command line's entry, for the installed script and for `python -m touchline`.

Every process of a pool imports this module again, and it runs before the module path is in order: at its top it imports
nothing but modules that Python has already loaded.
"""

import os
import sys


def main() -> None:
    """Run the command line; exits with its status."""
    put_current_directory_last(sys.path)
    import signal

    handler = signal.getsignal(signal.SIGINT)
    if handler is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends the imports without a traceback
    from touchline.commands.cli.command_line import main as run_command_line

    signal.signal(signal.SIGINT, handler)
    run_command_line()


def put_current_directory_last(module_path: list[str]) -> None:
    """Move the current directory behind all other folders, so that none of its files hides a module.

    `python -m` puts it first. If it is the checkout that this library runs from, it stays, and processes that are
    launched later find the library there, too.
    """
    here = os.path.realpath(os.curdir)
    library = os.path.realpath(__file__).rsplit(os.sep, 4)[0]
    found = [entry for entry in module_path if os.path.realpath(entry) == here]
    if here == library:
        known = os.environ.get("PYTHONPATH", "")
        if found and here not in known.split(os.pathsep):
            os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, (here, known)))
        return
    for entry in found:
        module_path.remove(entry)
    module_path.extend(found[:1])
