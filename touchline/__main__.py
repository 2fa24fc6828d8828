"""`python -m touchline`: the command line. Every process of a pool imports this module again."""

from touchline.commands.cli.script import main

if __name__ == "__main__":
    main()
