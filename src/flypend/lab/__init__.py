"""The laboratory: a page in the browser whose sliders change a flight while it plays."""
