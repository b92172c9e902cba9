"""Grades a submission to First Light for Classroom 50, and writes result.json and release-body.md.

Its place is CLASSROOM/autograders/ASSIGNMENT/autograder.py in the organization's repository `classroom50`.
The grader comes from {course}, a handout without solutions: only stages/*/src is the student's.
Exit code 0 means that the submission was graded, whatever its points are.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

COURSE = "{course}"
REFERENCE = "{reference}"
WHAT = "{what}"
OPTIONS = "{options}".split()
STAGES = "{stages}".split()

# Students' code runs with these variables alone: the runner's tokens are none of them.
KEPT = ["PATH", "HOME", "LANG", "CARGO_HOME", "RUSTUP_HOME", "RUSTUP_TOOLCHAIN", "GITHUB_SERVER_URL"]
RESULT = [
    "CLASSROOM", "ASSIGNMENT", "ASSIGNMENT_TYPE", "OWNER", "SUBMISSION_TAG",
    "COMMIT_URL", "RELEASE_URL", "REVIEW_URL",
]


def take_stages(student: Path, course: Path) -> None:
    """Replaces the sources of the stages by the student's. Links are not followed.

    A stage that is missing stays as in the handout: it is not written yet.
    """
    for stage in STAGES:
        below = Path("stages") / stage / "src"
        root = student / below / "lib.rs"
        if not root.is_file() or root.is_symlink():
            continue
        shutil.rmtree(course / below, ignore_errors=True)
        (course / below).mkdir(parents=True)
        for folder, _, names in os.walk(student / below):
            for name in names:
                source = Path(folder) / name
                if source.suffix == ".rs" and source.is_file() and not source.is_symlink():
                    target = course / source.relative_to(student)
                    target.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copyfile(source, target)


def main() -> int:
    student = Path.cwd()
    course = Path(tempfile.mkdtemp()) / "course"
    server = os.environ.get("GITHUB_SERVER_URL", "https://github.com")
    url = os.environ.get("FIRST_LIGHT_COURSE", f"{server}/{COURSE}.git")
    clone = ["git", "clone", "--quiet", "--depth", "1", "--branch", REFERENCE, url, str(course)]
    subprocess.run(clone, check=True)
    take_stages(student, course)
    graded = subprocess.run(
        ["cargo", "grader", WHAT, *OPTIONS, "--format", "actions",
         "--write", f"classroom50={student / 'result.json'}",
         "--write", f"markdown={student / 'release-body.md'}"],
        cwd=course,
        env={name: os.environ[name] for name in KEPT + RESULT if name in os.environ},
        check=False,
    )
    # 0: every core point; 1: points are lost; everything else: the grader failed.
    return 0 if graded.returncode in (0, 1) else graded.returncode


if __name__ == "__main__":
    sys.exit(main())
