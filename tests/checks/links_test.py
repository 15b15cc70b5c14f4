#!/usr/bin/env python3
"""Sees links.py follow good links and notice every kind of broken one."""
import pathlib
import tempfile
import unittest

from links import broken_links

GOOD = """# A page: with *points*, and `code`
![picture](pictures/a.png "title") [the page itself](#a-page-with-points-and-code) [folder](pictures) [web](https://x.y/z)
[there](docs/b.md) [heading](docs/b.md#two-words) `a[i](j)`
`docs/b.md` `docs/b.md --all` `src/<name>.cpp` `tests/*.md` `build/nothing`
```
[not a link](nowhere.md)
```
"""
BROKEN = ["[a](docs/c.md)", "![a](a.png)", "[a](docs/b.md#other)", "[a](#b)", "[a](pictures/a.png#part)",
          "`docs/c.md`", "`src/base`", "`tests/run.py --all`"]


class Links(unittest.TestCase):
    def found_in(self, text):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, content in {"a.md": text, "docs/b.md": "# B\n## Two words\n[up](../a.md)\n", "pictures/a.png": "",
                                  "build-x/c.md": "[generated](nowhere)"}.items():
                (root / name).parent.mkdir(exist_ok=True)
                (root / name).write_text(content)
            return list(broken_links(root))

    def test_good_links_pass(self):
        self.assertEqual(self.found_in(GOOD), [])

    def test_every_broken_link_is_found_once(self):
        for link in BROKEN:
            with self.subTest(link):
                self.assertEqual(len(self.found_in(GOOD + link)), 1)


if __name__ == "__main__":
    unittest.main()
