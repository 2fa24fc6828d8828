"""`python -m touchline`: the command line. Every forked robot imports this module again."""

from touchline.script import main

if __name__ == "__main__":
    main()
