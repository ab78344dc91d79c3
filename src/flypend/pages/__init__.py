"""Browser pages: the replay, and the bundled scripts that the laboratory uses too."""
