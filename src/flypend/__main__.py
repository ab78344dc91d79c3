"""`python -m flypend` is the command line."""

from flypend.cli.app import main

main()
