"""Runs commands that the documentation shows."""
import os
import re
import shlex
import subprocess

TIMEOUT = 300  # seconds, of one command, also on a busy machine


class CommandFailed(Exception):
    pass


def run(words, folder, program, exit_code=0):
    """Output of a command, standard error first, as it is written first."""
    words = [str(program) if word == "plumbline" and i == 0 else word for i, word in enumerate(words)]
    environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8",
                   "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    done = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True, timeout=TIMEOUT,
                          check=False)
    if done.returncode != exit_code:
        raise CommandFailed(f"exit code {done.returncode} in place of {exit_code}: {shlex.join(words)}\n"
                            f"{done.stdout[-2000:]}{done.stderr[-2000:]}")
    # lines of progress depend on the time that is taken
    return done.stdout if exit_code == 0 else re.sub(r"^ *\d+ %  .*\n", "", done.stderr, flags=re.M) + done.stdout
