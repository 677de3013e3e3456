"""scripts/release.sh in a small repository of its own, with a package that is there already: what it makes and what it refuses."""

import pathlib
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import unittest
import zipfile

SOURCE = pathlib.Path(sys.argv.pop())
RENDER = "_render" + sysconfig.get_config_var("EXT_SUFFIX")
CORE = "_core" + sysconfig.get_config_var("EXT_SUFFIX")
WHEEL = f"osteomill-1.2.3-cp311-cp311-{sysconfig.get_platform().replace('-', '_')}.whl"


def run(*command, cwd):
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True)


class Release(unittest.TestCase):
    def setUp(self):
        self.keep = tempfile.TemporaryDirectory()
        self.addCleanup(self.keep.cleanup)
        self.key = pathlib.Path(self.keep.name) / "release.key"
        self.tree = pathlib.Path(self.keep.name) / "tree"
        (self.tree / "scripts").mkdir(parents=True)
        for script in ("release.sh", "bill_of_materials.py"):
            shutil.copy(SOURCE / "scripts" / script, self.tree / "scripts")
        (self.tree / "python").mkdir()
        for file in ("setup.py", "pyproject.toml"):
            shutil.copy(SOURCE / "python" / file, self.tree / "python")
        shutil.copytree(SOURCE / "python/osteomill", self.tree / "python/osteomill", ignore=shutil.ignore_patterns("__pycache__"))
        (self.tree / "CMakeLists.txt").write_text("project(osteomill VERSION 1.2.3 LANGUAGES CXX)\n")
        (self.tree / "CHANGELOG.md").write_text("# Changelog\n\n## 1.2.3\n\n- It mills.\n\n## 1.2.2\n\n- It hums.\n")
        (self.tree / ".gitignore").write_text("/out/\n/build/\n")
        self.git("init", "--quiet")
        self.commit()

    def git(self, *words):
        said = run("git", "-c", "user.name=a", "-c", "user.email=a@b.example", *words, cwd=self.tree)
        self.assertEqual(said.returncode, 0, said.stderr)
        return said.stdout.strip()

    def commit(self):
        """And a package of what is committed, as scripts/package.sh leaves one."""
        self.git("add", "--all")
        self.git("commit", "--quiet", "--allow-empty", "-m", "a change")
        made = self.tree / "out" / "made"
        (made / "DEBIAN").mkdir(parents=True, exist_ok=True)
        modules = made / "usr/lib/python3/dist-packages/osteomill"
        for folder in (made / "usr/bin", modules):
            folder.mkdir(parents=True, exist_ok=True)
        shutil.copy("/bin/false", modules / CORE)
        shutil.copy("/bin/true", modules / RENDER)
        shutil.copy("/bin/true", made / "usr/bin/haptic_server")
        (made / "DEBIAN/control").write_text("Package: osteomill-server\nVersion: 1.2.3\nArchitecture: all\n"
                                             "Maintainer: a <a@b.example>\nDescription: a\n")
        packages = self.tree / "out/packages"
        packages.mkdir(exist_ok=True)
        built = run("dpkg-deb", "--build", str(made), str(packages / "osteomill-server_1.2.3_all.deb"), cwd=self.tree)
        self.assertEqual(built.returncode, 0, built.stderr)
        (packages / "commit").write_text(self.git("rev-parse", "HEAD") + "\n")

    def release(self, *options):
        return run("scripts/release.sh", "--dry-run", *options, cwd=self.tree)

    def refusal(self, *options):
        said = self.release(*options)
        self.assertEqual(said.returncode, 1, said.stdout)
        self.assertEqual(said.stderr.count("\n"), 1, said.stderr)
        return said.stderr

    def test_has_checksums_that_the_key_signs_and_no_tag(self):
        public = self.key.with_suffix(".pub")
        run("minisign", "-G", "-W", "-s", str(self.key), "-p", str(public), cwd=self.tree)
        said = self.release("--minisign", str(self.key))
        self.assertEqual(said.returncode, 0, said.stderr)
        out = self.tree / "out/release/1.2.3"
        self.assertEqual({file.name for file in out.iterdir()},
                         {"osteomill-server_1.2.3_all.deb", WHEEL, "osteomill-1.2.3.spdx.json", "SHA256SUMS", "SHA256SUMS.minisig"})
        self.assertEqual(run("sha256sum", "--check", "--strict", "SHA256SUMS", cwd=out).returncode, 0)
        self.assertEqual(len((out / "SHA256SUMS").read_text().splitlines()), 3)
        check = ("minisign", "-V", "-p", str(public), "-m", "SHA256SUMS")
        self.assertIn(self.git("rev-parse", "HEAD"), run(*check, cwd=out).stdout)
        self.assertEqual(self.git("tag"), "")
        with open(out / "SHA256SUMS", "a") as sums:
            sums.write("more\n")
        self.assertNotEqual(run(*check, cwd=out).returncode, 0)

    def test_has_a_wheel_of_the_core_in_the_package(self):
        bytes_of_wheel = []
        for _ in range(2):
            said = self.release()
            self.assertEqual(said.returncode, 0, said.stderr)
            file = self.tree / "out/release/1.2.3" / WHEEL
            bytes_of_wheel.append(file.read_bytes())
            with zipfile.ZipFile(file) as wheel:
                self.assertEqual(wheel.read(f"osteomill/{CORE}"), pathlib.Path("/bin/false").read_bytes())
                self.assertEqual(wheel.read(f"osteomill/{RENDER}"), pathlib.Path("/bin/true").read_bytes())
                self.assertIn("osteomill/_core.pyi", wheel.namelist())
        self.assertEqual(*bytes_of_wheel)

    def test_says_that_it_is_not_signed_without_a_key(self):
        said = self.release()
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("not signed", said.stdout)
        self.assertIn("is not tagged", said.stdout)

    def test_refuses_a_dirty_tree(self):
        (self.tree / "forgotten.cpp").write_text("")
        self.assertIn("not committed", self.refusal())

    def test_refuses_a_version_that_the_changelog_does_not_have(self):
        for text in ("## 1.2.2\n\n- It hums.\n", "## 1.2.3\n\n## 1.2.2\n\n- It hums.\n", "## 1.2.30\n\n- It mills.\n"):
            (self.tree / "CHANGELOG.md").write_text(text)
            self.commit()
            self.assertIn("says nothing of version 1.2.3", self.refusal(), text)

    def test_refuses_a_version_that_is_tagged(self):
        self.git("tag", "v1.2.3")
        self.assertIn("tagged already", self.refusal())

    def test_refuses_a_key_that_is_not_there(self):
        self.assertIn("there is no key", self.refusal("--minisign", str(self.key)))


if __name__ == "__main__":
    unittest.main()
