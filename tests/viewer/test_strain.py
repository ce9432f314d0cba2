"""A window under strain: thousands of events, hundreds of sizes, and at rest."""

from __future__ import annotations

import os
import time
from pathlib import Path

import numpy as np
import pytest
from driver import SIZE, Window, assert_no_complaint, same_picture

from reparam.snapshot import Studio
from reparam.subject import open_subject


@pytest.mark.slow
def test_a_thousand_random_keys_and_drags(window: Window) -> None:
    random = np.random.default_rng(7)
    keys = ["t", "m", "space", "c", "n", "w", "plus", "minus", "x", "shift+x", "b", "ctrl+z",
            "ctrl+y", "r", "h", "4", "5", "6", "9", "Next", "Prior", "F5", "Tab", "d", "q",
            "Return", "1", "period", "BackSpace"]  # fmt: skip
    done = 0
    while done < 1000:
        words: list[str] = []
        for _ in range(25):
            if random.random() < 0.5:
                words += ["key", str(random.choice(keys))]
            else:
                button = str(random.choice(["1", "1", "1", "3"]))
                words += ["mousemove", "--window", window.id, *place(random), "mousedown", button]
                for _ in range(3):
                    words += ["mousemove", "--window", window.id, *place(random)]
                words += ["mouseup", button]
            done += 1
        window.xdotool(*words)
        assert window.process.poll() is None, window.log.read_text()[-3000:]
    window.xdotool_key("Escape")  # a line may be asked for: this leaves it
    time.sleep(0.5)
    assert_no_complaint(window)
    if window.process.poll() is None:
        assert window.close() == 0


def place(random: np.random.Generator) -> list[str]:
    return [str(random.integers(0, SIZE[0])), str(random.integers(0, SIZE[1]))]


@pytest.mark.slow
def test_three_hundred_sizes(window: Window, studio: Studio) -> None:
    random = np.random.default_rng(8)
    sizes = random.integers(1, 800, (300, 2))
    memory = []
    for block in np.array_split(sizes, 30):
        words: list[str] = []
        for width, height in block:
            words += ["windowsize", window.id, str(width), str(height), "sleep", "0.02"]
        window.xdotool(*words)
        memory.append(resident(window))
    window.xdotool("windowunmap", window.id)
    time.sleep(0.3)
    window.xdotool("windowmap", "--sync", window.id)
    window.xdotool("windowsize", "--sync", window.id, *map(str, SIZE))
    time.sleep(0.5)
    assert same_picture(window.screenshot(), studio.draw(open_subject("fig5"), SIZE))
    assert max(memory[20:]) - max(memory[:10]) < 60 << 20
    assert_no_complaint(window)
    assert window.close() == 0


def resident(window: Window) -> int:
    """Bytes of memory that the window's process has."""
    pages = int(Path(f"/proc/{window.process.pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGESIZE")


def ticks(window: Window) -> int:
    """CPU time of the process so far, in hundredths of a second."""
    words = Path(f"/proc/{window.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) * 100 // os.sysconf("SC_CLK_TCK")


@pytest.mark.slow
def test_a_window_at_rest_uses_no_cpu(window: Window) -> None:
    time.sleep(12.0)  # the first line is gone by then
    before = ticks(window)
    time.sleep(5.0)
    assert ticks(window) - before < 5  # hundredths: 1 %
