"""What a command leaves behind: figures, movies, runs as files, and a report with verdicts, in one folder."""
