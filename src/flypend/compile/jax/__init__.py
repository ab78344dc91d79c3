"""The same programs as functions of JAX arrays, for a GPU."""
