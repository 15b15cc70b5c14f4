#!/usr/bin/env python3
"""Sees layering.py pass a clean tree and notice every kind of violation planted in it."""
import pathlib
import tempfile
import unittest

from layering import violations

CLEAN = {
    "src/base/parallel.hpp": "#include <omp.h>\n#pragma omp parallel for\nint n = omp_get_max_threads();\n",
    "src/observe/o.cpp": '#include <spdlog/spdlog.h>\n#include "output/h.hpp"\nvoid f() { spdlog::info("x"); }\n',
    "src/particles/a.hpp": '#include <vector>\n#include "base/parallel.hpp"\n#include "particles/b.hpp"\n',
    "src/insitu/v.cpp": "#include <vtkCellArray.h>\n",
    "src/output/h.cpp": "#include <hdf5.h>\n",
    "src/app/main.cpp": '#include "output/h.hpp"\nint main() { std::puts(""); std::exit(2); }\n',
    "src/scene/c.cpp": '// printf("no") and #pragma omp\n/* exit(1)\n std::cout */\nconst char* s = "std::cerr << printf(";\n'
                       "int snprintf_like(); void f() { view.exit(3); on_exit(4); }\n",
    "render/r.cpp": '#include "base/parallel.hpp"\n',
}
PLANTED = {
    "an include of a lower layer": ("src/base/bad.hpp", '#include "scene/scene.hpp"\n'),
    "an include of a lower layer by render": ("render/bad.cpp", '#include "insitu/v.hpp"\n'),
    "an include of an unknown layer": ("src/scene/bad.hpp", '#include "utils/all.hpp"\n'),
    "VTK": ("src/output/bad.cpp", "#include <vtkNew.h>\n"),
    "Catalyst": ("src/simulation/bad.cpp", "#  include <CatalystAdaptor.h>\n"),
    "HDF5": ("src/particles/bad.cpp", "#include <H5Cpp.h>\n"),
    "omp.h": ("src/schemes/bad.cpp", "#include <omp.h>\n"),
    "a pragma": ("src/base/bad.hpp", "  # pragma omp simd\n"),
    "printf": ("src/material/bad.cpp", 'int x; /* a\nb */ void f() { printf("x"); }\n'),
    "cout": ("render/bad.cpp", "void f() { std::cout << 1; }\n"),
    "the log": ("src/insitu/bad.cpp", 'void f() { spdlog::warn("x"); }\n'),
    "an exit of an observer": ("src/observe/bad.cpp", "void f() { std::exit(1); }\n"),
    "exit": ("src/simulation/bad.cpp", "void f() { std::exit(1); }\n"),
    "an unknown folder": ("src/utils/a.hpp", "\n"),
}


def plant(root, files):
    for name, text in files:
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


class Layering(unittest.TestCase):
    def found_with(self, *files):
        with tempfile.TemporaryDirectory() as folder:
            plant(pathlib.Path(folder), [*CLEAN.items(), *files])
            return list(violations(pathlib.Path(folder)))

    def test_a_clean_tree_passes(self):
        self.assertEqual(self.found_with(), [])

    def test_every_planted_violation_is_found_once(self):
        for what, file in PLANTED.items():
            with self.subTest(what):
                found = self.found_with(file)
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(file[0].rsplit("/", 1)[0]), found)


if __name__ == "__main__":
    unittest.main()
