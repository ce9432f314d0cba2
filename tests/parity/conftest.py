from __future__ import annotations

from collections.abc import Iterator

import pytest

from reparam.snapshot import Studio


@pytest.fixture(autouse=True)
def no_error_of_the_real_glu(request: pytest.FixtureRequest, one_studio: Studio) -> Iterator[None]:
    """libGLU asks whatever context is current, ours too, for what core profile has not. That error
    is nobody's: not of the test to come, in whatever folder. What a test draws is asked as ever."""
    draws = "studio" in request.fixturenames
    if draws:
        _forget_errors(one_studio)
    yield
    if not draws:
        _forget_errors(one_studio)


def _forget_errors(studio: Studio) -> None:
    with studio.ctx:
        while studio.ctx.error != "GL_NO_ERROR":
            pass
