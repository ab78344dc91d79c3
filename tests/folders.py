"""What a folder holds, for tests of what commands leave behind."""


def content(folder):
    """Everything below `folder`, hidden or not: name and bytes."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else None
        for path in sorted(folder.rglob("*"))
    }
