#!/usr/bin/env python3
"""Measures of the source tree: its size, and counts of what should be there once or not at all.

    python3 tests/measures.py             # a few seconds
    python3 tests/measures.py --minutes   # also builds and tests a clone of HEAD, an hour or two

prints one line per measure: its name, its value, the value to reach. All but the minutes come from the text of the files that git knows, which
the style lays out predictably: declarations of a namespace begin in the first column, one member stands on one line. "by hand" is what text
cannot tell.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter, defaultdict

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))


def sources(*folders, endings=(".h", ".cpp")):
    files = subprocess.check_output(["git", "ls-files", *folders], text=True).split("\n")
    return [file for file in files if file.endswith(endings) and os.path.exists(file)]


def read(file):
    with open(file, encoding="utf-8") as opened:
        return opened.read()


PRODUCT = {file: read(file) for file in sources("core", "reproduce", "widgets", "app")}
TESTS = {file: read(file) for file in sources("tests", endings=(".h", ".cpp", ".py"))}
OTHERS = {file: read(file) for file in sources("python", "vamp", "examples")}


def unit(file):
    return file.rsplit(".", 1)[0]


def inside(*folders):
    return {file: text for file, text in PRODUCT.items() if file.startswith(folders)}


def outside(*folders):
    return {file: text for file, text in PRODUCT.items() if not file.startswith(folders)}


def count(pattern, files):
    return sum(len(re.findall(pattern, text, re.M)) for text in files.values())


def holding(pattern, files):
    return sum(bool(re.search(pattern, text, re.M)) for text in files.values())


def row(name, value, aim):
    print(f"{name:<66} {value!s:>30}   {aim}")


# Size


def includes(text):
    for name in re.findall(r'^\s*#\s*include "([^"]+)"', text, re.M):
        for candidate in (name, "core/" + name):
            if candidate in PRODUCT:
                yield candidate


def with_one_includer(folder):
    """Headers in `folder` that a single file of the product includes, their own source aside."""
    includers = defaultdict(set)
    for file, text in PRODUCT.items():
        for header in includes(text):
            if unit(header) != unit(file):
                includers[header].add(file)
    return sum(len(files) == 1 for header, files in includers.items() if header.startswith(folder + "/"))


def test_programs():
    """Programs that ctest runs: those of test classes, and with those that are none (same bytes, parsers).

    Every call of faintline_tests and of faintline_parsers makes one, add_executable the rest; what is built by name, and fuzzers, are no tests.
    """
    made = re.findall(r"^ *(faintline_tests|faintline_parsers|add_executable)\((\w[^\s)]*)([^)]*)", read("tests/CMakeLists.txt"), re.M)
    made = [(how, name, rest) for how, name, rest in made if "EXCLUDE_FROM_ALL" not in rest and not re.search("fuzz|bench", name)]
    classes = sum(how == "faintline_tests" or "support/main.cpp" in rest for how, _, rest in made)
    return f"{classes} ({len(made)} with bytes and parsers)"


def size():
    for folder, aim in (("core", 45_000), ("app", 29_000), ("widgets", 13_000), ("tests", 48_000)):
        lines = sum(text.count("\n") for text in (TESTS if folder == "tests" else inside(folder + "/")).values())
        row(f"lines of {folder}", lines, f"<= {aim}")
    row("product files, with CMakeLists.txt", len(sources("core", "reproduce", "widgets", "app", endings=(".h", ".cpp", "CMakeLists.txt"))), "<= 750")
    row("headers of core with one includer", with_one_includer("core"), "<= 40")
    row("test programs", test_programs(), "<= 13")


# From the chain to the result

# What third-design.md, section 1, lists as stages after the chain, and as recursions written once more (presence: twice; that of the layers is
# carryAlong in PathTrace).
STAGES = ("secondLook explanation levelBeside searchBehind relink decideJointly familyTracks overOwnNoise overSides spreadTracks"
          " otherWindows trimEnds trimOnset").split()
PROGRAMMES = {"ForwardBackward": 1, "presence": 2, "jointPaths": 1, "PathTrace": 1}

# The rooms from frames to plan, and analyse. The chain's own model and calibrate are not among them.
ROOMS = tuple(f"core/{room}/" for room in "frames noise detect track refine plan analyse".split())

# Choosing between frames and recording: a file that hands frames to one call and a recording to another. Trials, which make theirs, do not choose.
ANALYSE = r"\banalyse(?:[A-Z]\w*)?\(\s*"
OF_FRAMES = rf"{ANALYSE}[\w.>-]*[fF]rames\b|[fF]rames\s*\? {ANALYSE}"
OF_RECORDING = rf"{ANALYSE}[\w.>-]*[rR]ecording\b"

# A constant's declaration; functions that are constexpr count too, which are two.
CONSTANT = r"^ *(?:inline |static )*constexpr\b"

# A constant whose whole name is one of these, without the quantity.
ADJECTIVE = (CONSTANT + r"[^;{}()=\n]*\b(?:most|least|fewest|largest|smallest|longest|shortest|farthest|nearest|highest|lowest|widest|narrowest|"
             r"deepest|rarest|latest|reach|share|deep|near|far|many|few|enough|steep)(?:\[\w*\])? *[={]")

# Questions of the core whether settings have no family (isNone), whether they have more than one channel or line, and whether lines are subtracted.
GUARD = (r"\b(?:family(?:\(\))?|settings)\.isNone\(\)"
         r"|\b(?:m_)?channel(?:s|Count)(?:\((?:[^()]|\(\))*\)|\.size\(\))? (?:[=!]=|>) 1\b|\blines\.size\(\) (?:[=!]=|>) 1\b"
         r'|\bsubtract\.lines\b(?!"| =)|\bsubtracts\b(?! =)|\bsubtracted\.empty\(\)|->unsubtracted\)')

STRUCT = r"^ *(?:template.*\n? *)?struct (?:\w+::)*(\w+)(?: final)?(?: *:(?!:)[^;{]*)?\s*\{"


def remaining(names, room):
    """Those of the units that still exist outside `room`."""
    there = {os.path.basename(unit(file)) for file in inside("core/") if not file.startswith(room)}
    return [name for name in names if name in there]


def uncommented(files):
    return {file: re.sub(r"//[^\n]*", "", text) for file, text in files.items()}


def stages():
    core, between = inside("core/"), inside(*ROOMS)
    headers = {file: text for file, text in core.items() if file.endswith(".h")}
    row("stages after the chain (of the 14 listed)", len(remaining(STAGES, "core/recursion/")), "<= 5")
    row('tests for "is it a line"', "by hand", "1")
    row("dynamic programmes outside recursion (of the 5 listed)",
        sum(PROGRAMMES[name] for name in remaining(PROGRAMMES, "core/recursion/")), "0")
    row("back-steps by hand", "by hand", "0")
    row("runs of the chain in a default detect: noise; signals", "by hand", "<= 2; <= 3")
    row("entry points", count(rf"^[^\s/*#(][^()\n]*{ANALYSE}", headers), "1")
    callers = uncommented({**outside("core/analyse/", "core/evaluate/"), **OTHERS})
    row("callers that choose frames or recording",
        sum(bool(re.search(OF_FRAMES, text) and re.search(OF_RECORDING, text)) for text in callers.values()), "0")
    row("named constants from frames to plan", count(CONSTANT, between), "<= 150")
    row("files that hold them", holding(CONSTANT, between), "one a room")
    row("spectrogram() outside frames and noise", count(r"\bspectrogram\(\)", outside("core/frames/", "core/noise/")), "0")
    row("smoothed.empty()", count(r"\bsmoothed\.empty\(\)", PRODUCT), "0")
    row("guards for family, channels, subtraction", count(GUARD, uncommented(core)), "<= 10")
    structs = Counter(name for text in core.values() for name in re.findall(STRUCT, text, re.M))
    name, most = structs.most_common(1)[0]
    row("struct names of core used more than once, in any scope", f"{sum(n > 1 for n in structs.values())}; {name} {most} times", "0")
    row("constants of core named by an adjective", count(ADJECTIVE, core), "<= 10")


# Rooms


def arrows(folder):
    """Arrows of inclusion between the folders and files directly in `folder`."""
    def room(file):
        return unit("/".join(file.split("/")[:len(folder.split("/")) + 1]))

    files = inside(folder + "/")
    return len({(room(a), room(b)) for a, text in files.items() for b in includes(text) if b in files and room(a) != room(b)})


def largest_room(folder):
    """The folder at any depth with the most units directly in it, and their number."""
    units = defaultdict(set)
    for file in inside(folder + "/"):
        units[os.path.dirname(file)].add(unit(file))
    room = max(units, key=lambda folder: len(units[folder]))
    return f"{len(units[room])}: {room.removeprefix(folder + '/')}"


def rooms():
    row("arrows of core", arrows("core"), "<= 45")
    row("units in the largest room of core", largest_room("core"), "<= 25")


# Window

# The signal of an object that is not the emitter. A lambda's `self`, the writer of the template writeAndReport and the view whose mouse is a file
# of its own are the emitter itself.
FOREIGN = r"\b(?:emit|Q_EMIT) (?!(?:this|self|writer|view|m_view)\b)\w+(?:\(\))?(?:\.|->)\w"

GETTER = re.compile(r" +(?!return\b|else\b|if\b)[\w:<>,*& \[\]]*[ *&](\w+)\(\) const\b(?!.*\boverride\b)[^;{]*[;{]")


def long_classes(limit):
    """How many classes are longer than `limit` lines over their header and the files that define their members, and the longest."""
    declared, files = Counter(), defaultdict(set)
    for file, text in PRODUCT.items():
        if file.endswith(".h"):
            names = re.findall(r"^class (\w+)(?: final)?(?: *:(?!:)[^;{]*)?\s*\{", text, re.M)
        else:
            names = re.findall(r"^(?:[^\s/#(][^(\n]*[ &*])?(\w+)(?:<[^>(\n]*>)?::(?:~?\w+|operator[^(\n]*)\(", text, re.M)
        for name in set(names):
            declared[name] += file.endswith(".h")
            files[name].add(file)
    lines = {name: sum(PRODUCT[file].count("\n") for file in of) for name, of in files.items() if declared[name] == 1}
    longest = max(lines, key=lines.get)
    return f"{sum(n > limit for n in lines.values())}; {longest} {lines[longest]}"


def descendants(name, children):
    return {name}.union(*(descendants(child, children) for child in children[name]))


def tested_accessors():
    """For app and widgets: public getters whose name only units of tests use, as far as these mention the class or one that derives from it."""
    words, children = defaultdict(set), defaultdict(set)
    for file, text in {**PRODUCT, **OTHERS, **TESTS}.items():
        words[unit(file)] |= set(re.findall(r"\w+", text))
        for child, parent in re.findall(r"^class (\w+)(?: final)?\s*:\s*(?:public|protected|private) (\w+)", text, re.M):
            children[parent].add(child)
    found = Counter()
    for file, text in inside("app/", "widgets/").items():
        owner, begun_as, is_public = None, "", False
        for line in text.split("\n") if file.endswith(".h") else ():
            begun = re.match(r"(class|struct) (\w+)", line)
            begun_as, owner = begun.groups() if begun else (begun_as, owner)
            is_public = begun_as == "struct" if begun else is_public
            access = re.match(r"(public|protected|private|signals)\b", line)
            is_public = access.group(1) == "public" if access else is_public
            getter = owner and is_public and GETTER.match(line)
            if getter:
                known = descendants(owner, children)
                users = [user for user, used in words.items() if getter.group(1) in used and known & used and not user.startswith(unit(file))]
                if begun_as == "struct" and re.search(rf"(?<!::)\b{getter.group(1)}\(", PRODUCT.get(unit(file) + ".cpp", "")):
                    continue  # what has no private part is used by its own unit, too
                found[file.split("/")[0]] += bool(users) and all(user.startswith("tests/") for user in users)
    return f"{found['app']}; {found['widgets']}"


def window():
    row("connects in the main window", count(r"\bconnect\(", inside("app/window/MainWindow")), "<= 40")
    row("threads when idle", "by hand", "<= 6")
    row("foreign emits", count(FOREIGN, PRODUCT), "0")
    not_live = outside("app/document/", "core/live/")
    live = r"\bisLive\(\)"
    row("isLive() outside document and live", f"{count(live, not_live)} in {holding(live, not_live)} files", "<= 4")
    row("classes over 600 lines over all their files", long_classes(600), "0")
    row("accessors called by tests alone: app; widgets", tested_accessors(), "0; 0")


# Minutes


def timed(command, folder, environment, log):
    """Runs a shell's command; processor minutes of it and all its children, and wall minutes."""
    begin = time.monotonic()
    with open(log, "wb") as opened:
        process = subprocess.Popen(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=opened, stderr=subprocess.STDOUT)
        _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    said = f"{(used.ru_utime + used.ru_stime) / 60:.1f}; {(time.monotonic() - begin) / 60:.1f}"
    return said if process.returncode == 0 else f"{said} (failed)"


def minutes():
    """The first command and then all tests in a clone of HEAD that knows no cache; their words go to log files, which stay."""
    logs = tempfile.mkdtemp(prefix="faintline-minutes-")
    print(f"log files: {logs}", file=sys.stderr)
    with tempfile.TemporaryDirectory(dir=logs, ignore_cleanup_errors=True) as folder:
        tree = os.path.join(folder, "tree")
        subprocess.check_call(["git", "clone", "--quiet", os.getcwd(), tree])
        if os.path.isdir("build/qwt/source"):
            shutil.copytree("build/qwt/source", os.path.join(tree, "build/qwt/source"), symlinks=True)
        environment = {name: value for name, value in os.environ.items() if name not in ("FAINTLINE_CACHE", "DISPLAY", "WAYLAND_DISPLAY")}
        environment |= {"CCACHE_DISABLE": "1", "QT_QPA_PLATFORM": "offscreen", "XDG_CACHE_HOME": os.path.join(folder, "cache")}
        return [timed(["sh", script], tree, environment, os.path.join(logs, log))
                for script, log in (("examples/run.sh", "first-command.log"), ("tests/run.sh", "tests.log"))]


def main(arguments):
    if arguments not in ([], ["--minutes"]):
        sys.exit("error: tests/measures.py: takes nothing, or --minutes")
    first, tests = minutes() if arguments else ["run with --minutes"] * 2
    row("measure", "now", "to reach")
    row("README's first command, minutes: processor; wall", first, "<= 12; any")
    row("tests/run.sh after it, minutes: processor; wall", tests, "<= 40; <= 20")
    size()
    stages()
    rooms()
    window()


if __name__ == "__main__":
    main(sys.argv[1:])
