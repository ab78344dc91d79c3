from flypend.model.disturbed import disturbed_motion  # noqa: F401
