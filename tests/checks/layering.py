#!/usr/bin/env python3
"""Checks the layers of the source tree. Usage: layering.py [ROOT]; prints every violation, exit status 1 if any.

- A folder includes only folders above it (and itself), in the order of LAYERS.
- ParaView and VTK are seen in src/insitu only, HDF5 in src/output only, OpenMP in src/base/parallel.hpp only.
- Nothing prints but src/app and src/observe, nothing exits but src/app.
"""
import pathlib
import re
import sys

LAYERS = ["base", "scene", "material", "model", "reference", "particles", "schemes", "sph", "grid", "hybrid", "simulation", "analysis", "render", "insitu",
          "output", "observe", "app"]

# What a line of code may match only in the files named by the second pattern, and what it is called.
RESERVED = [
    (r'#\s*include\s*[<"](vtk|pv|ParaView|Catalyst|catalyst)', r"src/insitu/", "ParaView or VTK"),
    (r'#\s*include\s*[<"](hdf5|H5)', r"src/output/", "HDF5"),
    (r'#\s*include\s*[<"]omp\.h|#\s*pragma\s+omp|\bomp_\w+\s*\(', r"src/base/parallel\.hpp$", "OpenMP"),
    (r"\b(printf|fprintf|vprintf|puts|fputs|putchar|perror)\s*\(|\bstd::(cout|cerr|clog)\b|\bfmt::print|\bspdlog::",
     r"src/app/|src/observe/", "printing"),
    (r"(?<![\w.>])(exit|quick_exit|abort)\s*\(|\bstd::(exit|quick_exit|abort)\b", r"src/app/", "ending the process"),
]


def code_lines(text):
    """The lines without comments, and without the contents of strings (includes keep theirs)."""
    text = re.sub(r"/\*.*?\*/", lambda m: "\n" * m.group().count("\n"), text, flags=re.S)
    for line in text.splitlines():
        if not re.match(r"\s*#\s*include", line):
            line = re.sub(r'"(\\.|[^"\\])*"', '""', line)
        yield re.sub(r"//.*", "", line)


def violations(root):
    for folder in LAYERS:
        place = root / ("render" if folder == "render" else f"src/{folder}")
        for path in sorted(place.rglob("*.[ch]pp")):
            name = path.relative_to(root).as_posix()
            for number, line in enumerate(code_lines(path.read_text()), 1):
                include = re.match(r'\s*#\s*include\s*"(\w+)/', line)
                if include and include.group(1) not in LAYERS:
                    yield f"{name}:{number}: includes {include.group(1)}/, which is no layer"
                elif include and LAYERS.index(include.group(1)) > LAYERS.index(folder):
                    yield f"{name}:{number}: {folder} includes {include.group(1)}, a layer below it"
                for pattern, allowed, what in RESERVED:
                    if re.search(pattern, line) and not re.match(allowed, name):
                        yield f"{name}:{number}: {what} outside its place: {line.strip()}"
    for path in sorted((root / "src").iterdir()):
        if path.is_dir() and path.name not in LAYERS:
            yield f"src/{path.name}: a folder that is no layer"


if __name__ == "__main__":
    found = list(violations(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) if found else "layers are clean")
    sys.exit(1 if found else 0)
