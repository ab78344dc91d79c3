"""Turns TOML files and names into vehicles, laws, plants and flights."""
