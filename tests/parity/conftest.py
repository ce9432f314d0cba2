from __future__ import annotations

import pytest

from reparam.snapshot import Studio


@pytest.fixture(autouse=True)
def no_error_of_the_real_glu(request: pytest.FixtureRequest) -> None:
    """libGLU asks whatever context is current, ours too, for what core profile has not."""
    if "studio" in request.fixturenames:
        studio: Studio = request.getfixturevalue("studio")
        while studio.ctx.error != "GL_NO_ERROR":
            pass
