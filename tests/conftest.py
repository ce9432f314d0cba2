from __future__ import annotations

from collections.abc import Iterator

import pytest

from reparam.snapshot import Studio


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-goldens", action="store_true", help="store the pictures drawn now as the goldens"
    )


@pytest.fixture(scope="session")
def one_studio() -> Studio:
    return Studio()


@pytest.fixture
def studio(one_studio: Studio) -> Studio:
    """One headless context for all tests of a process, current whatever others have made."""
    one_studio.ctx.__enter__()  # type: ignore[no-untyped-call]
    return one_studio


@pytest.fixture(autouse=True)
def no_opengl_error(request: pytest.FixtureRequest) -> Iterator[None]:
    """A test that draws leaves no OpenGL error behind."""
    yield
    if "one_studio" in request.fixturenames:
        assert request.getfixturevalue("one_studio").ctx.error == "GL_NO_ERROR"
