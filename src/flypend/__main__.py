"""`python -m flypend` is the command line."""

from flypend.cli import main

main()
