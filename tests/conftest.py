from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from reparam.errors import GraphicsError
from reparam.snapshot import Studio

NO_TESSELLATION = re.compile(r"expected OpenGL 4\.0|GLSL 4\.00 is not supported")


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


@pytest.fixture(params=["vertex", "tessellation"])
def evaluator(request: pytest.FixtureRequest, studio: Studio) -> Iterator[str]:
    """By each of them all that the studio draws."""
    if request.param == "tessellation" and not studio.painter.capabilities.tessellation:
        pytest.skip("OpenGL 4.0 is not there")
    studio.evaluator = request.param
    yield request.param
    studio.evaluator = None


@pytest.fixture
def own_context(studio: Studio) -> Iterator[None]:
    """A command opens a context of its own; afterwards the tests' one is current again."""
    yield
    studio.ctx.__enter__()


@pytest.fixture
def out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where a picture may be written; the working directory is beside it."""
    monkeypatch.chdir(tmp_path)
    return tmp_path / "out.png"


@pytest.fixture(autouse=True)
def no_opengl_error(request: pytest.FixtureRequest) -> Iterator[None]:
    """A test that draws leaves no OpenGL error behind."""
    yield
    if "one_studio" in request.fixturenames:
        assert request.getfixturevalue("one_studio").ctx.error == "GL_NO_ERROR"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    """A context of OpenGL 3.3 has no tessellation: tests that ask for it, by a parameter of that
    name or as their mark says, are skipped there, and only where that is what stopped them."""
    try:
        return (yield)
    except GraphicsError as error:
        studio = getattr(item, "funcargs", {}).get("one_studio")
        has = studio is None or studio.painter.capabilities.tessellation
        asked = "[tessellation" in item.name or "tessellation]" in item.name
        asked = asked or "-tessellation-" in item.name or item.get_closest_marker("tessellation")
        if has or not asked or not NO_TESSELLATION.search(str(error)):
            raise
        pytest.skip("tessellation needs OpenGL 4.0")
