"""`reparam bench --into FILE.md`: the tables of benchmarks with the machine that they are from."""

from __future__ import annotations

import os
import platform
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from .bench import Row, Skipped, module

HEAD = """# Benchmarks

`reparam bench` compares our frames with what a user would draw instead. A row is a *ratio in one
run*: both sides are run in turn, and the ratio is the median over the pairs, so that what disturbs
the machine disturbs both. Milliseconds are the medians of the same runs: they depend on the machine
and on what else it does, the ratios much less. Each table says what machine it is from, and its
load average: above the number of cores the times are many times those of an idle machine. No
figure here is from a GPU unless its table says so.

This file is made by `reparam bench --into docs/BENCHMARKS.md`; with the names of benchmarks only
their tables are made anew. Goals are ratios to be reached; where one is out of reach, the text
beneath the table says why. With few pairs on a busy machine a row near its goal may fall on either
side of it.
"""
COLUMNS = ("row", "ratio", "goal", "ours, ms", "other, ms", "settings")
CPU_INFO = Path("/proc/cpuinfo")


def machine() -> str:
    """Processor, what else it does, OpenGL and Python in one line."""
    from .snapshot import Studio

    found = Studio().painter.capabilities
    kind = "software rendering, no GPU" if found.software else f"GPU of {found.vendor}"
    busy = f" (load average {os.getloadavg()[0]:.1f})" if hasattr(os, "getloadavg") else ""
    return (
        f"{_processor()}, {os.cpu_count()} cores{busy}; {found.renderer}, OpenGL {found.driver}: "
        f"{kind}; Python {platform.python_version()}"
    )


def _processor() -> str:
    names = re.findall(r"^model name\s*:\s*(.+)$", _text(CPU_INFO), re.MULTILINE)
    return str(names[0]) if names else platform.processor() or platform.machine()


def _text(path: Path) -> str:
    return path.read_text("utf-8") if path.exists() else ""


def section(name: str, rows: Sequence[Row | Skipped], where: str) -> str:
    """A benchmark: what it measures, where, the table, and what there is to say about it."""
    source = module(name)
    lines = [f"## {name}", "", (source.__doc__ or "").strip(), "", f"*{where}.*", ""]
    measured = [row for row in rows if isinstance(row, Row)]
    if measured:
        lines += [_line(COLUMNS), _line(["---", *["---:"] * 4, "---"])]
        lines += [_line(_cells(row)) for row in measured]
        lines.append("")
    skipped = [row for row in rows if isinstance(row, Skipped)]
    lines += [f"* {row.name} was skipped: {row.reason}" for row in skipped]
    lines += [""] * bool(skipped)
    account = str(getattr(source, "ACCOUNT", "")).strip()
    return "\n".join([*lines, *([account, ""] if account else [])])


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _cells(row: Row) -> list[str]:
    goal = ""
    if row.goal is not None:
        sign, verdict = ("≥" if row.at_least else "≤"), ("" if row.reached() else " **missed**")
        goal = f"{sign} {row.goal:g}{verdict}"
    times = [
        "" if value is None else f"{value:.4g}" for value in (row.ours_ms, row.other_ms)
    ]  # fmt: skip
    return [f"`{row.name}`", f"{row.ratio:.3g}", goal, *times, _settings(row.settings)]


def _settings(settings: Mapping[str, Any]) -> str:
    return ", ".join(f"{name.replace('_', ' ')} {value}" for name, value in settings.items())


def written_into(path: Path, sections: Mapping[str, str]) -> None:
    """Put these sections into the file; the others that it has stay as they are.

    Raises OSError where the file cannot be written.
    """
    parts = re.split(r"^(?=## )", _text(path), flags=re.MULTILINE)[1:]
    found = {part.partition("\n")[0].removeprefix("## ").strip(): part for part in parts}
    found.update(sections)
    text = "\n".join([HEAD, *(found[name].strip() + "\n" for name in sorted(found))])
    path.write_text(text, "utf-8")
