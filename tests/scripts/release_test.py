"""scripts/release.sh in a small repository of its own, with packages that exist already: its products and its refusals. And the
wheel, which depends on the system, by scripts/wheel_of_packages.sh."""

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
STUDIES = "_studies" + sysconfig.get_config_var("EXT_SUFFIX")
CORE = "_core" + sysconfig.get_config_var("EXT_SUFFIX")
PYTHON = f"cp{sys.version_info.major}{sys.version_info.minor}"
WHEEL = f"osteomill-1.2.3-{PYTHON}-{PYTHON}-{sysconfig.get_platform().replace('-', '_')}.whl"
SUITES = {"bookworm": "osteomill-server_1.2.3+deb12u1_all.deb", "trixie": "osteomill-server_1.2.3+deb13u1_all.deb"}


def run(*command, cwd):
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True)


class Release(unittest.TestCase):
    def setUp(self):
        self.keep = tempfile.TemporaryDirectory()
        self.addCleanup(self.keep.cleanup)
        self.key = pathlib.Path(self.keep.name) / "release.key"
        self.tree = pathlib.Path(self.keep.name) / "tree"
        (self.tree / "scripts").mkdir(parents=True)
        for script in ("release.sh", "debian_suite.sh", "wheel_of_packages.sh", "bill_of_materials.py"):
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

    def commit(self, core=CORE):
        """And packages of what is committed for both systems, as scripts/package.sh leaves them."""
        self.git("add", "--all")
        self.git("commit", "--quiet", "--allow-empty", "-m", "a change")
        made = self.tree / "out" / "made"
        (made / "DEBIAN").mkdir(parents=True, exist_ok=True)
        modules = made / "usr/lib/python3/dist-packages/osteomill"
        for folder in (made / "usr/bin", modules):
            folder.mkdir(parents=True, exist_ok=True)
        for module in modules.iterdir():
            module.unlink()
        shutil.copy("/bin/false", modules / core)
        for module in (RENDER, STUDIES):
            shutil.copy("/bin/true", modules / module)
        shutil.copy("/bin/true", made / "usr/bin/haptic_server")
        (made / "usr/bin/osteomill_study").write_text("#!/usr/bin/python3 -Xutf8\n")
        (made / "DEBIAN/control").write_text("Package: osteomill-server\nVersion: 1.2.3\nArchitecture: all\n"
                                             "Maintainer: a <a@b.example>\nDescription: a\n")
        for suite, package in SUITES.items():
            packages = self.tree / "out/packages" / suite
            packages.mkdir(parents=True, exist_ok=True)
            built = run("dpkg-deb", "--build", str(made), str(packages / package), cwd=self.tree)
            self.assertEqual(built.returncode, 0, built.stderr)
            (packages / "commit").write_text(self.git("rev-parse", "HEAD") + "\n")

    def complete(self, suite):
        return run("scripts/wheel_of_packages.sh", f"out/packages/{suite}", cwd=self.tree)

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
        self.assertEqual({file.name for file in out.iterdir()}, {*SUITES.values(), "SHA256SUMS", "SHA256SUMS.minisig"})
        self.assertEqual(run("sha256sum", "--check", "--strict", "SHA256SUMS", cwd=out).returncode, 0)
        self.assertEqual(len((out / "SHA256SUMS").read_text().splitlines()), 2)
        check = ("minisign", "-V", "-p", str(public), "-m", "SHA256SUMS")
        self.assertIn(self.git("rev-parse", "HEAD"), run(*check, cwd=out).stdout)
        self.assertEqual(self.git("tag"), "")
        with open(out / "SHA256SUMS", "a") as sums:
            sums.write("more\n")
        self.assertNotEqual(run(*check, cwd=out).returncode, 0)

    def test_has_the_wheel_and_the_bill_that_are_beside_the_packages(self):
        packages = self.tree / "out/packages/bookworm"
        bytes_of_wheel = []
        for _ in range(2):
            said = self.complete("bookworm")
            self.assertEqual(said.returncode, 0, said.stderr)
            bytes_of_wheel.append((packages / WHEEL).read_bytes())
            with zipfile.ZipFile(packages / WHEEL) as wheel:
                self.assertEqual(wheel.read(f"osteomill/{CORE}"), pathlib.Path("/bin/false").read_bytes())
                self.assertEqual(wheel.read(f"osteomill/{RENDER}"), pathlib.Path("/bin/true").read_bytes())
                self.assertIn("osteomill/_core.pyi", wheel.namelist())
        self.assertEqual(*bytes_of_wheel)
        said = self.release()
        self.assertEqual(said.returncode, 0, said.stderr)
        names = {file.name for file in (self.tree / "out/release/1.2.3").iterdir()}
        self.assertIn(WHEEL, names)
        [bill] = [name for name in names if name.endswith(".spdx.json")]
        self.assertRegex(bill, r"osteomill-1\.2\.3-\w+\.spdx\.json")

    def test_makes_no_wheel_for_a_python_that_the_modules_are_not_for(self):
        other = CORE.replace(f"-{sys.version_info.major}{sys.version_info.minor}-", "-399-")
        self.assertNotEqual(other, CORE)
        self.commit(core=other)
        said = self.complete("bookworm")
        self.assertNotEqual(said.returncode, 0)
        self.assertIn(f"{CORE} is missing, the module for this Python", said.stderr)
        self.assertIn(other, said.stderr)
        self.assertEqual(list((self.tree / "out/packages/bookworm").glob("*.whl")), [])

    def test_refuses_packages_that_are_of_another_commit_or_of_one_system_alone(self):
        here = run("bash", "-c", ". scripts/debian_suite.sh && echo $suite", cwd=self.tree).stdout.strip()
        [other] = SUITES.keys() - {here} if here in SUITES else ["trixie"]
        (self.tree / "out/packages" / other / "commit").write_text("an older one\n")
        self.assertIn(f"out/packages/{other} holds no packages of this commit", self.refusal())
        shutil.rmtree(self.tree / "out/packages" / other)
        self.assertIn(f"out/packages/{other} holds no packages of this commit", self.refusal())

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
