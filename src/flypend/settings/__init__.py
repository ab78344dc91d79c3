"""TOML files and names become vehicles, laws, plants and flights here."""
