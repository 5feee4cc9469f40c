#!/usr/bin/env python3
"""Where the time of one picture goes, from the program's start to the file on the disk, in ms: the least and the median
of RUNS runs, in turns. Processor time is that of all threads. "other" is the choice of method and preset, the PNG file
and the program's end.

Usage: start_to_file.py PROGRAM INPUT [RUNS [OPTIONS...]]; options as of render, by default --size 512x512."""
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time


def run(arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)
    wall = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return 1e3 * wall, 1e3 * (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def main():
    program, source = sys.argv[1:3]
    runs = int(sys.argv[3]) if len(sys.argv) > 3 else 15
    options = sys.argv[4:] or ["--size", "512x512"]
    parts = {name: [] for name in ("start", "load", "octree", "rays", "other", "whole", "whole, processor")}
    with tempfile.TemporaryDirectory() as folder:
        picture, facts = os.path.join(folder, "x.png"), os.path.join(folder, "x.json")
        render = [program, "render", source, "-o", picture, "--quiet", *options]
        for i in range(runs + 1):
            start, _ = run([program, "--version"])
            run([*render, "--json", facts])
            whole, processor = run(render)
            if i == 0:  # warms the caches of files
                continue
            with open(facts, encoding="utf-8") as file:
                ms = json.load(file)["time_ms"]
            octree = ms["octree"] or 0
            rays = ms["first_frame"] - octree
            values = (start, ms["load"], octree, rays, whole - start - ms["load"] - octree - rays, whole, processor)
            for name, value in zip(parts, values):
                parts[name].append(value)
    for name, values in parts.items():
        print(f"{name:18} {min(values):7.1f} {statistics.median(values):7.1f}")


main()
