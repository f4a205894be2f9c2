"""The page on many ranks: messages and time by the program's model, and what was measured beside it."""
import csv
import re
import shlex
import subprocess
from concurrent.futures import ThreadPoolExecutor

from plumbline_run import CommandFailed, run

SCENE = "scenes/three_d/scalar_delta_convergence.prm"
SIDE = 488  # cells across a bar, so that it has some 1e9 with a plane for each of the largest number of ranks
RANKS = [64, 128, 256, 512, 1024, 2048, 4096]
N_CORES = 2  # of the machine where benchmarks/ranks.csv was measured
FACTOR = 1.5  # within which the model must be where all ranks have a core
OPERATIONS = ["operator", "preconditioner", "CG iteration"]
COLOURS = {"operator": "#0072b2", "CG iteration": "#d55e00"}


def command(n, h, n_ranks):
    """@param n  cells along each axis"""
    box = ", ".join(f"{length * h:.15g}" for length in n)
    return ["plumbline", "run", SCENE, "--levels", "1", "--methods", "FA", "--set", f"Domain/boxes=0, 0, 0 : {box}",
            "--set", f"Study/h={h:.15g}", "--set", "Study/m=3", "--estimate", "--ranks", str(n_ranks)]


def predict(n, h, n_ranks, work, program):
    """Rows of the table that the program prints, by operation, and the constants that it names."""
    text = run(command(n, h, n_ranks), work, program)
    table = text[text.index("predicted time"):]
    constants = " ".join(re.search(r"\n(time = .*?)\n\n", table, re.S).group(1).split())
    lines = [re.split(r" {2,}", line.strip()) for line in table.split("\n\n")[1].splitlines() if line.strip()]
    rows = {}
    for line in lines[1:]:
        row = dict(zip(lines[0], line))
        rows[row["operation"]] = {key: float(value) for key, value in row.items()
                                  if key in lines[0][lines[0].index("planes"):] and key != "operation"}
    if set(rows) != set(OPERATIONS):
        raise CommandFailed(f"operations {sorted(rows)} in place of {OPERATIONS}")
    return rows, constants


def predictions(work, program):
    """The rows of each study for each number of ranks."""
    studies = [("strong", "cube", lambda n_ranks: [1000, 1000, 1000], 1 / 1000),
               ("strong", "bar", lambda n_ranks: [SIDE, SIDE, RANKS[-1]], 1 / SIDE),
               ("weak", "bar", lambda n_ranks: [SIDE, SIDE, n_ranks], 1 / SIDE)]
    found = []
    with ThreadPoolExecutor(2) as pool:
        for study, body, cells, h in studies:
            tables = list(pool.map(lambda n_ranks: predict(cells(n_ranks), h, n_ranks, work, program), RANKS))
            found.append({"study": study, "body": body, "cells": cells, "constants": tables[0][1],
                          "rows": {n_ranks: rows for n_ranks, (rows, _) in zip(RANKS, tables)}})
    return found


def has_cores(rows):
    """Where each rank has a core."""
    return [row for row in rows if row["ranks"] <= N_CORES]


def measurements(root):
    """Rows of benchmarks/ranks.csv, as numbers; the model must be near where each rank has a core."""
    with (root / "benchmarks" / "ranks.csv").open(encoding="utf-8") as lines:
        rows = [{key: value if key in ("study", "operation") else float(value) for key, value in row.items()}
                for row in csv.DictReader(lines)]
    for row in rows:
        row["unknowns"] = row["nx"] * row["ny"] * row["nz"]
    for row in has_cores(rows):
        ratio = row["seconds"] / row["model"]
        if not 1 / FACTOR < ratio < FACTOR:
            raise ValueError(f"benchmarks/ranks.csv: {row['operation']} on {row['ranks']:g} ranks takes {ratio:.2f} "
                             "times as long as predicted; measure again on an idle machine, or correct the model")
    return rows


def curves(study, predicted, measured):
    """(title, style, points) of a chart: core seconds for each unknown, in ns."""
    found = []
    for operation, colour in COLOURS.items():
        for one in (p for p in predicted if p["study"] == study):
            points = []
            for n_ranks in RANKS:
                n = one["cells"](n_ranks)
                time = one["rows"][n_ranks][operation]["time [ms]"]
                points.append((n_ranks, 1e6 * time * n_ranks / (n[0] * n[1] * n[2])))
            dash = 1 if one["body"] == "bar" else 2
            found.append((f"{operation}, {one['body']}: model of a cluster",
                          f"lines lc rgb '{colour}' lw 2 dt {dash}", points))
        rows = [row for row in measured if row["study"] == study and row["operation"] == operation]

        def points_of(some, key):
            return [(row["ranks"], 1e9 * row[key] * min(row["ranks"], N_CORES) / row["unknowns"]) for row in some]
        found.append((f"{operation}: model, constants measured", f"lines lc rgb '{colour}' lw 1 dt 3",
                      points_of(has_cores(rows), "model")))
        for title, some, shape in ((f"{operation}: measured", has_cores(rows), 7),
                                   (f"{operation}: measured, ranks share cores",
                                    [row for row in rows if row["ranks"] > N_CORES], 6)):
            found.append((title, f"points lc rgb '{colour}' pt {shape} ps 1", points_of(some, "seconds")))
    return found


def draw(file, some):
    """A chart by gnuplot, which draws those of reports, too."""
    data = "".join("".join(f"{x:g} {y:.6g}\n" for x, y in points) + "e\n" for _, _, points in some)
    plots = ", ".join(f"'-' with {style} title '{title}'" for title, style, _ in some)
    script = (f"set terminal svg size 900,520 font 'sans-serif,13' background '#ffffff'\nset output '{file}'\n"
              "set logscale x 2\nset logscale y\nset xrange [.8:6000]\nset grid lc rgb '#dddddd'\n"
              "set xlabel 'ranks'\nset ylabel 'cores x time / unknowns [ns]'\nset key outside bottom center maxcols 2\n"
              f"plot {plots}\n{data}")
    done = subprocess.run(["gnuplot"], input=script, text=True, capture_output=True, check=False)
    if done.returncode != 0 or not file.exists():
        raise CommandFailed(f"gnuplot draws no {file.name}: {done.stderr[-500:]}")


def duration(seconds):
    return f"{seconds:.3g} s" if seconds >= 1 else f"{1e3 * seconds:.3g} ms"


def model_table(one):
    lines = ["| ranks | cells | planes of a rank | ranks at work | operator | preconditioner | CG iteration | "
             "messages of a rank in an iteration | sent by a rank in an iteration |", "|" + "---|" * 9]
    for n_ranks, rows in one["rows"].items():
        whole = rows["CG iteration"]
        n = one["cells"](n_ranks)
        lines.append(f"| {n_ranks} | {n[0]} × {n[1]} × {n[2]} | {whole['planes']:g} | {whole['ranks at work']:g} | "
                     + " | ".join(duration(1e-3 * rows[name]["time [ms]"]) for name in OPERATIONS)
                     + f" | {whole['messages']:g} | {whole['sent [MB]']:.3g} MB |")
    return lines


def measured_table(rows):
    lines = ["| scaling | ranks | nodes | operation | measured | model | ratio | messages of a rank | sent by a rank |",
             "|" + "---|" * 9]
    for row in rows:
        ratio = row["seconds"] / row["model"]
        lines.append(f"| {row['study']} | {row['ranks']:g} | {row['nx']:g} × {row['ny']:g} × {row['nz']:g} | "
                     f"{row['operation']} | {duration(row['seconds'])} | {duration(row['model'])} | {ratio:.2f} | "
                     f"{row['messages']:g} | {row['bytes'] * 1e-6:.3g} MB |")
    return lines


def conclusions(predicted):
    """What the tables say of the largest number of ranks, relative to the smallest."""
    lines = []
    for one in predicted:
        first, last = (one["rows"][n_ranks]["CG iteration"] for n_ranks in (RANKS[0], RANKS[-1]))
        gain = RANKS[-1] / RANKS[0]
        ratio = first["time [ms]"] / last["time [ms]"]
        share = (last["latency [ms]"] + last["bandwidth [ms]"]) / last["time [ms]"]
        if one["study"] == "strong":
            text = (f"an iteration is {ratio:.1f} times as fast on {RANKS[-1]} ranks as on {RANKS[0]}; ideal: "
                    f"{gain:g}; {last['ranks at work']:g} ranks have planes")
        else:
            text = (f"with constant work per rank, an iteration on {RANKS[-1]} ranks takes {1 / ratio:.2f} times as "
                    f"long as on {RANKS[0]}")
        lines.append(f"- *{one['study'].capitalize()} scaling, {one['body']}*: {text}. Messages take {100 * share:.0f} % "
                     f"of the time there.")
    return lines


def page(root, program, work, pictures):
    pictures.mkdir(parents=True, exist_ok=True)
    predicted, measured = predictions(work, program), measurements(root)
    for study in ("strong", "weak"):
        draw(pictures / f"ranks_{study}.svg", curves(study, predicted, measured))
    here = [row["seconds"] / row["model"] for row in has_cores(measured)]

    def picture(study, text):
        return ["```{raw} html", f'<figure class="result"><a href="../_static/gallery/ranks_{study}.svg">'
                f'<img src="../_static/gallery/ranks_{study}.svg" alt="{text}"></a><figcaption>{text}</figcaption></figure>',
                "```", ""]
    example = shlex.join(command([1000, 1000, 1000], 1 / 1000, RANKS[-1]))
    parts = [
        "# Many ranks: messages and time", "",
        "In three dimensions, ranks own slabs of planes of a box ([parallel runs](run.md#parallel-runs)). This page gives "
        "the number and volume of their messages, and predicts by a model how long an iteration takes on a cluster. The "
        "build of this site runs the commands and draws the charts. The measured values are those of "
        "`benchmarks/ranks.csv`, which the program `benchmarks/ranks` writes.", "",
        "## Messages", "",
        "| operation | messages that a rank sends | bytes that a rank sends |", "|---|---|---|",
        "| operator (in transient analyses: forces) | one for each component to each rank whose slab is within the reach of "
        "the stencil | the planes that the other rank needs |",
        "| preconditioner: sine transform and its inverse | two for each component to each other rank | its planes, then "
        "its rows of modes, without the part that it keeps |",
        "| sum over all ranks; three in an iteration of conjugate gradients (CG) | ⌈log₂ P⌉ (recursive doubling) | 8 for "
        "each message |", "",
        "The counts of the first two operations follow from the slabs alone and are exact. Tests on 1, 2, 3, 4 and 8 ranks "
        "compare those of the operator with the messages that are posted, and those of the preconditioner with the sizes "
        "that FFTW reports. In transient analyses, consistent masses of `Q1` send further planes, which the model leaves "
        "out. A rank computes planes that need no data of other ranks while messages are in transit; the model does not "
        "take the time that this saves into account.", "",
        "## Model of a cluster", "",
        "`plumbline run SCENE --estimate --ranks P` prints the model for scenes whose domain is one box and runs nothing. "
        "Without `--ranks` it is for the ranks that `mpirun` starts. The model: " + predicted[0]["constants"] + ". All parts are "
        "those of the rank for which they take longest. The model contains neither contention nor network links that "
        "several ranks share: where they do, divide the bandwidth by their number.", "",
        "The charts show cores × time / unknowns, which is constant where scaling is ideal, for `FA` at m = 3. The cluster "
        f"solves a cube of 1000³ cells, and a bar of {SIDE} × {SIDE} cells across and {RANKS[-1]} along it "
        f"({SIDE * SIDE * RANKS[-1]:.2g} cells; in weak scaling one plane for each rank). The points were measured on "
        f"one machine with {N_CORES} cores, for a smaller box ({measured[0]['nx']:g} nodes across): dots where each rank "
        "has a core, circles where 4 or 8 ranks share the two cores, which says nothing about a cluster.", "",
        *picture("strong", "Strong scaling: the same box on more ranks"),
        *picture("weak", "Weak scaling: more ranks, the same number of cells on each"),
        *conclusions(predicted), "",
        "A slab has at least one plane, so a cube of n³ cells can use at most n ranks. The planes that a rank receives, "
        "twice the reach of the stencil, do not become fewer with more ranks. The longest side of the box should therefore "
        "be along z.", ""]
    for one in predicted:
        parts += [f"### {one['study'].capitalize()} scaling, {one['body']}", "", *model_table(one), ""]
    parts += ["One of the commands:", "", f"```{{command}} {example}", "```", "",
              "## Measured", "",
              f"`mpirun -np P build/release/benchmarks/ranks` measures the constants and the operations in one run, as medians, "
              "for a stencil of radius 3: α and β by ping-pong between two ranks, rates of work by all ranks at once. "
              "On 4 and 8 ranks, which share two cores, operations shorter than the time slices of the operating system "
              "are not comparable with these rates. On 1 and 2 ranks the measured times are "
              f"{min(here):.2f} to {max(here):.2f} times those of the model (asserted: within a factor of {FACTOR:g}).", "",
              *measured_table(measured), ""]
    return "\n".join(parts)
