"""Atomic writes of files and folders, and NetCDF."""
