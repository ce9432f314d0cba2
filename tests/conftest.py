from __future__ import annotations

from collections.abc import Iterator

import pytest

from reparam.snapshot import Studio


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-goldens", action="store_true", help="store the pictures drawn now as the goldens"
    )


@pytest.fixture(scope="session")
def studio() -> Studio:
    """One headless context for all tests of a process."""
    return Studio()


@pytest.fixture(autouse=True)
def no_opengl_error(request: pytest.FixtureRequest) -> Iterator[None]:
    """A test that draws leaves no OpenGL error behind."""
    yield
    if "studio" in request.fixturenames:
        assert request.getfixturevalue("studio").ctx.error == "GL_NO_ERROR"
