#!/usr/bin/env python3
"""Arrows point one way: scans the include lines against the table of the folders.

Usage: layering.py ROOT | layering.py --self-test

Ours are included as "folder/file.h" from the repository's root, everything else in angle brackets
and only from the list of the layer. Operating system and vendor headers belong to drivers and
boards. A board includes board/box, which all share and which knows no driver, and never another
board. Nothing below a board asks a clock: time comes with the field.
"""
import pathlib
import re
import sys
import tempfile

from source_text import code_only, plant, report, sources

BASE = ["core/base"]
TRACKING = BASE + ["core/camera", "core/tubesheet", "core/edges"]
MATH = ["core/math"]
PICTURE = BASE + MATH + ["core/camera", "core/edges"]
POSE = PICTURE + ["core/picture", "core/tubesheet"]

# Folder: the folders of ours it may include beside itself.
MAY_INCLUDE = {
    "core/base": [],
    "core/math": BASE,
    "hal": BASE,
    "core/camera": BASE,
    "core/tubesheet": BASE,
    "core/edges": BASE,
    "core/tracking": TRACKING,
    "core/picture": PICTURE,
    "core/pose": POSE,
    "core/kinematics": BASE + MATH,
    "core/detection": BASE + MATH + ["core/picture", "core/pose"],
    "core/calibration": POSE + ["core/pose", "core/detection", "core/kinematics"],
    "core/lighting": BASE,
    "core/verification": BASE + MATH + ["core/tubesheet", "core/tracking", "core/pose"],
    "core/overlay": BASE + ["core/camera", "core/tubesheet"],
    "core/rendering": BASE + MATH + ["core/camera", "core/tubesheet", "core/kinematics"],
    "core/session": POSE + ["core/tracking", "core/pose", "core/calibration", "core/kinematics",
                            "core/lighting", "core/verification", "core/overlay"],
    "drivers/files": BASE + ["hal"],
    # Drivers do not know each other, with two exceptions: drivers/files holds what all that read files
    # share (places and messages), and is the library that a recording as a frame grabber stands on;
    # drivers/camera holds what cameras of all buses share.
    "drivers/camera": BASE,
    "drivers/aravis": BASE + ["hal", "drivers/camera"],
    "drivers/v4l2": BASE + ["hal", "drivers/camera"],
    "drivers/camera_yaml": BASE + ["drivers/files"],
    "drivers/settings": BASE + ["hal", "core/tubesheet", "drivers/files"],
    "drivers/ffmpeg": BASE + ["drivers/files"],
    "drivers/recording": BASE + ["hal", "drivers/files"],
    "drivers/replay": BASE + ["hal", "drivers/files"],
    "drivers/journal": BASE + ["hal"],
    "drivers/modbus": BASE + ["hal"],
    "drivers/web": BASE + ["drivers/files"],
    "drivers/simulated": BASE + ["hal", "core/tubesheet", "core/rendering", "core/kinematics"],
}
MAY_INCLUDE["drivers/scenario"] = [
    # Reads what the simulated world plays, and lets camera and session judge whether it can be tracked.
    *MAY_INCLUDE["drivers/simulated"], "core/camera", "core/session", "drivers/files", "drivers/settings",
    "drivers/simulated"]
ANY_DRIVER = BASE + ["hal"]
# What all boards share. It knows the ports and no adapter, so that any board can bring its own.
BOX = "board/box"

# No owning container, no stream, no std::function, no lock: what core and hal may take of std.
CORE_STD = set("""algorithm array atomic bit cassert chrono cmath compare concepts cstddef cstdint
    cstdlib cstring iterator limits numbers numeric optional ratio source_location span string_view
    tuple type_traits utility variant version""".split())
EIGEN_FOLDERS = ("core/base", "core/math", "core/picture", "core/pose", "core/detection",
                 "core/calibration", "core/kinematics", "core/rendering", "core/verification")

DRIVER_STD = CORE_STD | set("""bitset cctype cerrno charconv cinttypes climits condition_variable
    cstdarg cstdio deque filesystem functional initializer_list map memory mutex new set string
    system_error thread unordered_map unordered_set vector""".split())
POSIX = re.compile(r"^(errno|fcntl|poll|sched|signal|unistd|sys/[a-z_]+)\.h$")
DRIVER_LIBRARY = {
    # Its library is loaded when it is needed; the address of ours is asked of a socket.
    "drivers/aravis": re.compile(r"^((arpa/inet|arv|dlfcn|netinet/in|semaphore)\.h|ctime)$"),
    "drivers/camera_yaml": re.compile(r"^yaml\.h$"),
    "drivers/files": re.compile(r"^((lzma|png|zlib)\.h|csetjmp)$"),  # libpng's way out of an error
    "drivers/gpio": re.compile(r"^gpiod\.h$"),
    "drivers/journal": re.compile(r"^(openssl/(bio|evp|pem)|sqlite3)\.h$"),
    "drivers/modbus": re.compile(r"^(modbus/modbus|linux/serial|netinet/in)\.h$"),
    "drivers/settings": re.compile(r"^toml\+\+/"),
    "drivers/simulated": re.compile(r"^Eigen/Core$"),  # transforms are made of it
    "drivers/v4l2": re.compile(r"^linux/videodev2\.h$"),
    "drivers/watchdog": re.compile(r"^linux/watchdog\.h$"),
    # libjpeg's way out of an error; libcrypt; addresses of browsers; its threads' names.
    "drivers/web": re.compile(r"^((microhttpd|jpeglib|crypt|gnutls/(abstract|crypto|gnutls|x509)|arpa/inet|"
                              r"netinet/in|strings)\.h|csetjmp|ctime|fstream)$"),
}

FORBIDDEN_BELOW_BOARD = [
    (re.compile(r"::now\s*\("), "asks a clock; time comes with the field or from hal::Clock"),
    (re.compile(r"\b(clock_gettime|gettimeofday|std::time|std::clock)\s*\("), "asks a clock"),
]
FORBIDDEN_IN_CORE = [
    (re.compile(r"\bstd::(stable_sort|stable_partition|inplace_merge)\b"), "allocates"),
    (re.compile(r"\bstd::(string|vector|function|map|set|deque|list|unique_ptr|shared_ptr)\b"),
     "owns memory"),
    (re.compile(r"\b(new|malloc|calloc|realloc)\s*[\[(]|\bnew\s+\w"), "allocates"),
    (re.compile(r"\b(throw\b|dynamic_cast\s*<|typeid\s*\()"), "needs exceptions or RTTI"),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def folder_of(path):
    """The row of the table that a path of ours belongs to: "core/base", "hal", "board/bench"."""
    parts = path.split("/")
    return parts[0] if parts[0] in ("hal", "tests") else "/".join(parts[:2])


def own_include_problem(root, folder, target):
    if not (root / target).is_file():
        return f'"{target}" is no file below the repository; others go in angle brackets'
    to = folder_of(target)
    if to == folder:
        return None
    if folder.startswith("board/") and folder != BOX:
        if to.startswith("board/") and to != BOX:
            return f"{folder} may not include {to}: what boards share stands in {BOX}"
        return "a board may not include tests" if to == "tests" else None
    if folder == BOX:
        return (None if to == "hal" or to.startswith("core/")
                else f"{BOX} may not include {to}: it knows the ports and the core alone")
    allowed = MAY_INCLUDE.get(folder, ANY_DRIVER if folder.startswith("drivers/") else None)
    if allowed is None:
        return f"the folder {folder} has no row in the table of tests/checks/layering.py"
    return None if to in allowed else f"{folder} may not include {to}"


def system_include_problem(folder, target):
    if folder == BOX:
        return None if target in DRIVER_STD else f"<{target}> is not on the list of {folder}"
    if folder.startswith("board/"):
        return None
    if folder.startswith("drivers/"):
        library = DRIVER_LIBRARY.get(folder)
        if target in DRIVER_STD or POSIX.match(target) or (library and library.match(target)):
            return None
        return f"<{target}> is not on the list of {folder}"
    if target in CORE_STD or (target.startswith("Eigen/") and folder in EIGEN_FOLDERS):
        return None
    return f"<{target}> is not on the list of {folder}"


def check(root):
    root = pathlib.Path(root)
    problems = []
    files = sources(root, ["core", "hal", "drivers", "board"])
    for path in files:
        name = path.relative_to(root).as_posix()
        folder = folder_of(name)
        text = path.read_text(encoding="utf-8")
        for number, line in enumerate(text.splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            quote, target = match.groups()
            problem = (own_include_problem(root, folder, target) if quote == '"'
                       else system_include_problem(folder, target))
            if problem:
                problems.append(f"{name}:{number}: {problem}")
        if folder.startswith("board/") and folder != BOX:
            continue
        rules = list(FORBIDDEN_BELOW_BOARD)
        if folder.startswith("core/") or folder == "hal":
            rules += FORBIDDEN_IN_CORE
        for number, line in enumerate(code_only(text).splitlines(), 1):
            if line.lstrip().startswith("#"):
                continue
            for pattern, why in rules:
                if pattern.search(line):
                    problems.append(f"{name}:{number}: '{line.strip()}' {why}")
    return problems, len(files)


# Planted violations: file, text, a part of the message; None where nothing may be found.
PLANTED = [
    ("core/base/good.h", "#include <span>\n#include <Eigen/Core>\n// std::vector, new x, now()\n",
     None),
    ("core/camera/good.cpp", '#include "core/base/good.h"\nauto s = "throw std::string";\n', None),
    ("drivers/files/good.cpp", '#include <lzma.h>\n#include <vector>\n#include "core/base/good.h"\n',
     None),
    ("board/bench/good.cpp", '#include <iostream>\n#include "drivers/files/own.h"\n', None),
    ("drivers/files/own.h", "", None),
    ("tests/support/fake.h", "", None),
    ("board/box/good.h", '#include <vector>\n#include "hal/os.h"\n#include "core/camera/good.h"\n',
     None),
    ("board/bench/box.cpp", '#include "board/box/good.h"\n#include "board/bench/own.h"\n', None),
    ("board/bench/own.h", "", None),
    ("board/visionbox/bench.cpp", '#include "board/bench/own.h"\n', "may not include board/bench"),
    ("board/box/bench.cpp", '#include "board/bench/own.h"\n', "may not include board/bench"),
    ("board/box/driver.cpp", '#include "drivers/files/own.h"\n', "may not include drivers/files"),
    ("board/box/fake.cpp", '#include "tests/support/fake.h"\n', "may not include tests"),
    ("board/box/os.cpp", "#include <unistd.h>\n", "<unistd.h> is not on the list"),
    ("board/box/clock.cpp", "auto t = std::chrono::steady_clock::now();\n", "asks a clock"),
    ("core/base/up.cpp", '#include "core/camera/good.h"\n', "core/base may not include core/camera"),
    ("core/camera/good.h", "", None),
    ("core/edges/side.cpp", '#include "core/camera/good.h"\n', "may not include core/camera"),
    ("core/tracking/driver.cpp", '#include "drivers/files/own.h"\n', "may not include drivers/files"),
    ("hal/fake.h", '#include "tests/support/fake.h"\n', "hal may not include tests"),
    ("board/bench/fake.cpp", '#include "tests/support/fake.h"\n', "may not include tests"),
    ("core/unknown/a.cpp", '#include "core/base/good.h"\n', "no row in the table"),
    ("core/base/relative.cpp", '#include "good.h"\n', "is no file below the repository"),
    ("core/base/stream.h", "#include <iostream>\n", "<iostream> is not on the list"),
    ("core/edges/vector.h", "#include <vector>\n", "<vector> is not on the list"),
    ("core/edges/eigen.h", "#include <Eigen/Core>\n", "<Eigen/Core> is not on the list"),
    ("hal/os.h", "#include <unistd.h>\n", "<unistd.h> is not on the list"),
    ("drivers/files/replay.cpp", '#include "drivers/replay/a.h"\n', "may not include drivers/replay"),
    ("drivers/replay/a.h", '#include "drivers/files/own.h"\n', None),
    ("drivers/camera/own.h", "", None),
    ("drivers/v4l2/shared.h", '#include "drivers/camera/own.h"\n', None),
    ("drivers/v4l2/side.h", '#include "drivers/aravis/own.h"\n', "may not include drivers/aravis"),
    ("drivers/aravis/own.h", "", None),
    ("drivers/gpio/camera.h", '#include "drivers/camera/own.h"\n', "may not include drivers/camera"),
    ("drivers/replay/png.cpp", "#include <png.h>\n", "<png.h> is not on the list"),
    ("drivers/replay/clock.cpp", "auto t = std::chrono::steady_clock::now();\n", "asks a clock"),
    ("core/session/clock.cpp", "auto t = Clock::now ();\n", "asks a clock"),
    ("core/tracking/heap.cpp", "auto* p = new int;\n", "allocates"),
    ("core/tracking/sort.cpp", "std::stable_sort(a, b);\n", "allocates"),
    ("core/tracking/throw.cpp", "void f() { throw 1; }\n", "exceptions"),
]


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        plant(root, ((name, text) for name, text, _ in PLANTED))
        found, _ = check(root)
    wrong = []
    for name, _, expected in PLANTED:
        own = [problem for problem in found if problem.startswith(name + ":")]
        if expected is None and own:
            wrong.append(f"reported without reason: {own}")
        if expected is not None and not any(expected in problem for problem in own):
            wrong.append(f"not caught: {name}: {expected}; reported: {own}")
    return report("layering --self-test", wrong, f"{len(PLANTED)} planted files")


if __name__ == "__main__":
    if sys.argv[1] == "--self-test":
        sys.exit(self_test())
    list_of_problems, number_of_files = check(sys.argv[1])
    if number_of_files == 0:
        list_of_problems.append("no source found: wrong folder?")
    sys.exit(report("layering", list_of_problems, f"{number_of_files} files"))
