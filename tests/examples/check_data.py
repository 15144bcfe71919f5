#!/usr/bin/env python3
"""usage: tests/examples/check_data.py SOURCE   examples/get_data on a made-up set, by a mirror on this computer, an
archive and a folder: it verifies, replaces nothing, refuses other content, and says what is to be put where. And
examples/recordings.json has every file that the studies and pages of the checkout SOURCE take from ../shared/data."""

import hashlib
import http.server
import json
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
from functools import partial
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
FILES = {"one.sto": b"1 2 3\n", "two.trc": b"4 5 6\n"}


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def entry(name, content):
    return {"name": name, "bytes": len(content), "sha256": hashlib.sha256(content).hexdigest()}


class GetData(unittest.TestCase):
    def setUp(self):
        self.work = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.work / "examples").mkdir()
        shutil.copy(SOURCE / "examples/get_data", self.work / "examples")
        recording = {
            "folder": "made-up", "what": "numbers", "authors": "nobody", "licence": "MIT", "changed": "",
            "repositories": ["nobody/numbers@0123abc"], "licence_file": entry("LICENSE", b"free\n"),
            "files": [entry(*each) for each in FILES.items()],
        }  # fmt: skip
        (self.work / "examples/recordings.json").write_text(json.dumps([recording]))
        self.mirror = self.work / "mirror"
        (self.mirror / "made-up").mkdir(parents=True)
        for name, content in {**FILES, "LICENSE": b"free\n"}.items():
            (self.mirror / "made-up" / name).write_bytes(content)
        self.target = self.work / "data"

    def call(self, *arguments):
        return subprocess.run([sys.executable, self.work / "examples/get_data", "--to", self.target, *arguments],
                              capture_output=True, text=True, check=False, timeout=60)  # fmt: skip

    def test_a_mirror_gives_every_file_with_its_licence(self):
        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=self.mirror)) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            done = self.call("--from", f"http://127.0.0.1:{server.server_port}")
            (self.target / "made-up/two.trc").unlink()
            (self.mirror / "made-up/two.trc").unlink()
            absent = self.call("--from", f"http://127.0.0.1:{server.server_port}/")
            server.shutdown()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.target / "made-up/one.sto").read_bytes(), FILES["one.sto"])
        self.assertTrue((self.target / "made-up/LICENSE").is_file())
        self.assertEqual(absent.returncode, 1)
        self.assertIn("404", absent.stderr)

    def test_without_a_network_it_says_what_belongs_where(self):
        # A port without a server stands for the missing network.
        done = self.call("--from", "http://127.0.0.1:9")
        self.assertEqual(done.returncode, 1)
        self.assertNotIn("Traceback", done.stderr)
        self.assertIn(str(self.target / "made-up"), done.stdout)
        for name, content in FILES.items():
            self.assertIn(name, done.stdout)
            self.assertIn(hashlib.sha256(content).hexdigest()[:16], done.stdout)

    def test_other_content_is_not_taken_and_a_file_that_is_there_stays(self):
        (self.mirror / "made-up/one.sto").write_bytes(b"forged\n")
        (self.target / "made-up").mkdir(parents=True)
        (self.target / "made-up/two.trc").write_bytes(b"my own\n")
        done = self.call("--from", self.mirror)
        self.assertEqual(done.returncode, 1)
        self.assertFalse((self.target / "made-up/one.sto").exists())
        self.assertEqual((self.target / "made-up/two.trc").read_bytes(), b"my own\n")
        self.assertIn("two.trc", done.stderr)
        (self.target / "made-up/two.trc").unlink()
        (self.target / "made-up/two.trc").symlink_to("absent")
        self.assertNotEqual(self.call("--from", self.mirror).returncode, 0)
        self.assertTrue((self.target / "made-up/two.trc").is_symlink())

    def test_an_archive_goes_round_and_is_the_same_each_time(self):
        self.assertEqual(self.call("--from", self.mirror).returncode, 0)
        archives = [self.work / "first.tar.gz", self.work / "second.tar.gz"]
        for archive in archives:
            self.assertEqual(self.call("--pack", archive).returncode, 0)
        self.assertEqual(archives[0].read_bytes(), archives[1].read_bytes())
        self.assertEqual(self.call("--pack", archives[0]).returncode, 0)
        own = self.target / "made-up/two.trc"
        self.assertNotEqual(self.call("--pack", own).returncode, 0)
        self.assertEqual(own.read_bytes(), FILES["two.trc"])
        shutil.rmtree(self.target)
        self.assertEqual(self.call("--from", archives[0]).returncode, 0)
        self.assertEqual(self.call("--check").returncode, 0)
        (self.target / "made-up/one.sto").write_bytes(b"changed\n")
        self.assertEqual(self.call("--check").returncode, 1)
        self.assertNotEqual(self.call("--pack", self.work / "third.tar.gz").returncode, 0)
        self.assertFalse((self.work / "third.tar.gz").exists())


class Manifest(unittest.TestCase):
    def test_it_has_every_file_that_studies_and_pages_name(self):
        listed = {
            f"{recording['folder']}/{each['name']}"
            for recording in json.loads((SOURCE / "examples/recordings.json").read_text())
            for each in recording["files"]
        }
        named = set()
        for page in [*SOURCE.glob("examples/**/*.toml"), *SOURCE.glob("docs/**/*.md"), *SOURCE.glob("examples/**/*.md")]:
            named |= set(re.findall(r"shared/data/([\w-]+/[\w.-]+\.\w+)", page.read_text()))
        self.assertGreater(len(named), 20)
        self.assertEqual(named - listed, set())


if __name__ == "__main__":
    unittest.main()
