"""The output of a command in one folder: figures, movies, saved runs, and a report with verdicts."""
