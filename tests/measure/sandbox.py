#!/usr/bin/env python3
"""What decoding in processes of their own costs: sandbox.py PROGRAM RUNS SERIES...

Loads each series with and without --no-sandbox, in turn, and prints the medians of both, by the clock and in processor
time with that of the decoders, and the ratios of the medians.
"""
import os
import statistics
import subprocess
import sys
import time

program, runs = sys.argv[1], int(sys.argv[2])
for series in sys.argv[3:]:
    clock, work = {"": [], "--no-sandbox": []}, {"": [], "--no-sandbox": []}
    sums = set()
    for run in range(runs + 1):
        for option in clock if run % 2 else reversed(list(clock)):
            before, start = os.times(), time.perf_counter()
            out = subprocess.run([program, "info", series, "--quiet", "--json"] + [o for o in [option] if o], check=True,
                                 capture_output=True).stdout.decode()
            took, after = time.perf_counter() - start, os.times()
            sums.add(out[out.index("stored_crc32"):].split(",")[0])
            if run:  # the first pair fills the disk's cache
                clock[option].append(1e3 * took)
                used = after.children_user + after.children_system - before.children_user - before.children_system
                work[option].append(1e3 * used)
    inside, outside = clock["--no-sandbox"], clock[""]
    ratio = statistics.median(outside) / statistics.median(inside)
    ratio_work = statistics.median(work[""]) / statistics.median(work["--no-sandbox"])
    print(f"{os.path.basename(series):24} {statistics.median(inside):7.0f} ms in the program, {statistics.median(outside):7.0f} ms "
          f"in decoders: {ratio:.3f}; processor {ratio_work:.3f}; {'same values' if len(sums) == 1 else 'VALUES DIFFER'}")
