"""The mathematics: numpy float64, no OpenGL, no files, no scenes."""
