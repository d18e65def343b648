#!/usr/bin/env python3
"""Measures of the source tree: sizes of files and functions, and counts of patterns that should disappear.

    python3 tests/measures.py

prints one line per measure, from the text of the files alone. Functions are recognised by the layout of the style: an opening brace alone on
its line, at the indentation of the closing one.
"""

import os
import re
import subprocess
from collections import defaultdict

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
COLUMNS = 120


def tracked(*patterns):
    return subprocess.check_output(["git", "ls-files", *patterns], text=True).split()


def sources(*folders):
    return [f for folder in folders for f in tracked(folder) if f.endswith((".h", ".cpp"))]


def read(file):
    with open(file, encoding="utf-8") as opened:
        return opened.read()


PRODUCT = {file: read(file) for file in sources("core", "widgets", "app")}
TESTS = {file: read(file) for file in sources("tests")}
OTHERS = {file: read(file) for file in sources("python", "vamp", "examples")}


def count(pattern, files=PRODUCT, without=()):
    return sum(len(re.findall(pattern, text)) for file, text in files.items() if not file.startswith(tuple(without)))


def includes(file, text):
    for name in re.findall(r'^\s*#\s*include "([^"]+)"', text, re.M):
        for candidate in (name, "core/" + name):
            if candidate in PRODUCT:
                yield candidate


def unit(file):
    return file.rsplit(".", 1)[0]


def circles():
    """Sets of units that include each other (Tarjan's strongly connected components)."""
    graph = defaultdict(set)
    for file, text in PRODUCT.items():
        graph[unit(file)] |= {unit(other) for other in includes(file, text)} - {unit(file)}
    number, low, stack, found = {}, {}, [], []

    def visit(node):
        number[node] = low[node] = len(number)
        stack.append(node)
        for other in graph[node]:
            if other not in number:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], number[other])
        if low[node] == number[node]:
            members = stack[stack.index(node):]
            del stack[stack.index(node):]
            if len(members) > 1:
                found.append(members)

    for node in list(graph):
        if node not in number:
            visit(node)
    return found


def rooms(folder):
    """Folders and files directly in `folder`, and the arrows of inclusion between them."""
    def room(file):
        return unit("/".join(file.split("/")[:len(folder.split("/")) + 1]))

    inside = {file for file in PRODUCT if file.startswith(folder + "/")}
    arrows = {(room(a), room(b)) for a in inside for b in includes(a, PRODUCT[a]) if b in inside and room(a) != room(b)}
    return len({room(file) for file in inside}), len(arrows)


def largest_room(folder):
    """The folder at any depth with the most units directly in it, and their number."""
    units = defaultdict(set)
    for file in PRODUCT:
        if file.startswith(folder + "/"):
            units[os.path.dirname(file)].add(unit(file))
    room = max(units, key=lambda folder: len(units[folder]))
    return f"{len(units[room])}: {room.removeprefix(folder + '/')}"


def functions():
    """(file, lines, parameters) of each function that is defined."""
    for file, text in PRODUCT.items():
        lines = text.split("\n")
        for i, line in enumerate(lines):
            if line not in ("{", "    {"):
                continue
            end = next((j for j in range(i, len(lines)) if re.match(line.replace("{", "}") + r"\W*$", lines[j])), i)
            start = i - 1
            while start > 0 and lines[start - 1].strip() and not re.search(r"[;{}>]\s*$|^\s*//|^\s*#|:$", lines[start - 1]):
                start -= 1
            head = " ".join(lines[start:i])
            if "(" not in head or re.match(r"\s*(class|struct|enum|namespace)\b", head):
                continue
            yield file, end - start + 1, parameters(head)


def parameters(head):
    depth, commas, text = 0, 0, ""
    for letter in head[head.index("("):]:
        depth += letter in "([{<"
        depth -= letter in ")]}>"
        if depth == 0:
            break
        commas += letter == "," and depth == 1
        text += letter
    return commas + 1 if text.strip("( ") else 0


def length(texts):
    return sum(text.count("\n") for text in texts)


def ratio(product, tests):
    return length(t for f, t in TESTS.items() if f.startswith(tests)) / length(t for f, t in PRODUCT.items() if f.startswith(product))


def formatted():
    """Files that clang-format would change; nothing where it is not installed."""
    try:
        said = subprocess.run(["clang-format", "--dry-run", *PRODUCT, *TESTS, *OTHERS], text=True, stderr=subprocess.PIPE, check=False).stderr
    except FileNotFoundError:
        return "?"
    return len(set(re.findall(r"^(\S+?):\d+:\d+: warning", said, re.M)))


def row(name, value, aim):
    print(f"{name:<66} {value!s:>16}   {aim}")


def main():
    row("measure", "now", "to reach")
    row("forks of lines and pings outside FrameKind",
        count(r"\b(?:takesBoxes|isSeenSingly)\b", without=("app/document/FrameKind.", "widgets/")), "5")
    row("dynamic_cast in core / elsewhere", f"{count(r'dynamic_cast<', without=('app', 'widgets'))} / {count(r'dynamic_cast<', without=('core',))}", "0 / 0")
    row("circles of units", len(circles()), "0")
    row("axes.size(), but for loops over the axes", count(r"axes\.size\(\)(?!; \+\+)"), "8")
    for folder, aim in (("core", "14 (91)"), ("app", "14 (40)"), ("widgets", "7 (10)"), ("core/evaluate", "7 (12)")):
        row(f"rooms of {folder} (arrows)", "{} ({})".format(*rooms(folder)), aim)
    for folder in ("core", "app", "widgets"):
        row(f"units in the largest room of {folder}", largest_room(folder), "40")
    all_functions = list(functions())
    row("functions over 60 lines", sum(lines > 60 for _, lines, _ in all_functions), "6")
    row("functions with more than five parameters", sum(n > 5 for *_, n in all_functions), "10")
    row("files over 400 lines", sum(text.count("\n") > 400 for text in PRODUCT.values()), "6")
    row("static_cast", count(r"static_cast<"), "900")
    for product, tests, aim in (("core", ("tests/",), 0.65), ("core/model", ("tests/model", "tests/detect"), 0.6),
                                ("core/evaluate", ("tests/evaluate",), 0.5), ("widgets", ("tests/widgets",), 0.4)):
        tested = ratio(product + "/", tests) if product != "core" else length(
            t for f, t in TESTS.items() if not f.startswith(("tests/app", "tests/widgets"))) / length(
            t for f, t in PRODUCT.items() if f.startswith("core/"))
        row(f"lines of tests a line of {product}", f"{tested:.2f}", aim)
    everything = [line for text in (*PRODUCT.values(), *TESTS.values(), *OTHERS.values()) for line in text.split("\n")]
    row(f"lines over {COLUMNS} columns", sum(len(line) > COLUMNS for line in everything), "0")
    row("files that clang-format would change", formatted(), "0")


if __name__ == "__main__":
    main()
