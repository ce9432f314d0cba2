"""One module a scene, found by its name."""
