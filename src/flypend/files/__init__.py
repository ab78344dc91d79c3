"""Atomic writes of files and folders, arrays, and NetCDF."""
