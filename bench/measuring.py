"""What the benchmark scripts of this folder share: timed runs, facts of the machine, tables."""

import datetime
import json
import os
import pathlib
import platform
import re
import signal
import subprocess
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "bench" / "results"
GRACE_S = 60  # from the request to stop to the end of patience


def run(command, folder, environment=None, limit_s=None):
    """Runs a command to its end, or ends it after `limit_s` and kills it where it does not heed that.

    Returns its exit code, its output (both streams), and a dictionary of wall and processor seconds, peak memory in
    bytes, the moment of its start as files carry it, and whether the limit was reached.
    """
    limited = []
    with tempfile.TemporaryFile(dir=folder) as output:
        began, start = time.time(), time.monotonic()
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=subprocess.STDOUT, env={**os.environ, **(environment or {})})

        # SIGTERM, not SIGINT: what runs in the background of a script ignores the latter.
        def stop(which):  # not process.send_signal, which may take the exit status away from wait4
            limited.append(which)
            os.kill(process.pid, which)

        timers = [threading.Timer(seconds, stop, [which]) for seconds, which in
                  [(limit_s, signal.SIGTERM), (limit_s + GRACE_S, signal.SIGKILL)]] if limit_s else []
        for timer in timers:
            timer.daemon = True
            timer.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            os.kill(process.pid, signal.SIGKILL)
            os.waitpid(process.pid, 0)
            raise
        finally:
            for timer in timers:
                timer.cancel()
        wall = time.monotonic() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read().decode(errors="replace")
    return process.returncode, text, {
        "wall": wall, "processor": usage.ru_utime + usage.ru_stime, "memory": usage.ru_maxrss * 1024,
        "began": began, "limited": bool(limited)}


def summary_of(take):
    """Facts of a run of Windfall, however it ended; empty where it ended before the first was written."""
    path = take / "summary.json"
    return json.loads(path.read_text()) if path.exists() else {}


def error_of(text):
    """The message of a run of Windfall that failed; empty where there is none."""
    return " ".join(re.findall(r"^windfall: error: (.*)", text, re.MULTILINE))


def first_match(pattern, text):
    match = re.search(pattern, text, re.MULTILINE)
    return match[1] if match else "unknown"


def output_of(*command):
    try:
        result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return "unknown"
    return result.stdout.strip() or "unknown"


def load_text(load):
    return " ".join(f"{value:.2f}" for value in load)


def machine(program, load):
    """Pairs of a fact's name and the fact: what the numbers were measured with."""
    processor = first_match(r"^model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    memory_gib = int(first_match(r"^MemTotal: +(\d+)", pathlib.Path("/proc/meminfo").read_text())) / 2 ** 20
    return [
        ("machine", f"{processor}, {len(os.sched_getaffinity(0))} cores, {memory_gib:.0f} GiB memory; "
                    f"{platform.system()} {platform.release()}"),
        ("kernels", first_match(r"^kernels +(.*)", output_of(program, "doctor"))),
        ("load before", load_text(load)),
        ("date", datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")),
        ("commit", output_of("git", "describe", "--always", "--dirty")),
        ("program", output_of(program, "--version")),
    ]


def bullets(facts):
    return "\n".join(f"- {name}: {value}" for name, value in facts)


def table(rows):
    """A table of Markdown; the first row is its head."""
    rows = [rows[0], ["---"] * len(rows[0]), *rows[1:]]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def written(form, value):
    """A cell of a table: "-" where there is no value."""
    return "-" if value is None else form.format(value)


def add_program(parser):
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/apps/cli/windfall",
                        help="the windfall program (build/release/apps/cli/windfall)")


def check_program(parser, arguments):
    arguments.program = arguments.program.resolve()
    if not arguments.program.is_file():
        parser.error(f"{arguments.program} is not there: build the release preset, or say --program")


def publish(text, path):
    """The page on stdout, and in a file where one is wanted."""
    print(text)
    if path:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
