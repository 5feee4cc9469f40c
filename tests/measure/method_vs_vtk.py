#!/usr/bin/python3
"""A method against one of VTK's mappers on the same machine: a series, the same orbit and transfer function, in turns in one
run; medians over the orbit and the ratio. Usage: method_vs_vtk.py PROGRAM SERIES BENCH [ROUNDS] [METHOD] [gpu|cpu] [SIDE]
[STEPS] [LOOKS], the last two lists like 0.5,1 and plain,shaded,mip,tissue; for BENCH see beside_vtk.py."""
import json, os, statistics, subprocess, sys, tempfile
from beside_vtk import metaimage, ours, points, preset, theirs

program, series, bench = sys.argv[1:4]
rounds = int(sys.argv[4]) if len(sys.argv) > 4 else 2
method = sys.argv[5] if len(sys.argv) > 5 else 'slicing'
mapper = sys.argv[6] if len(sys.argv) > 6 else 'gpu'
side = sys.argv[7] if len(sys.argv) > 7 else '512'
size = f'{side}x{side}'
steps = [float(x) for x in (sys.argv[8] if len(sys.argv) > 8 else '0.5,1').split(',')]
looks = (sys.argv[9] if len(sys.argv) > 9 else 'plain,shaded').split(',')
frames = 12


def our_time(step, look):
    text = subprocess.run(
        ours(program, series, preset(bench, look, work), look, size) +
        ['-o', os.path.join(work, 'x.png'), '--method', method, '--view', '0,20', '--step', str(step), '--repeat', str(frames),
         '--orbit', '360', '--json', '-'], check=True, capture_output=True, text=True).stdout
    return json.loads(text)['time_ms']['frame_median']


def their_time(step, look):
    text = subprocess.run(
        theirs(bench, volume, points(bench, look), look, size, step, mapper) + ['--frames', str(frames)], check=True,
        capture_output=True, text=True).stdout
    return float(text.split('\t')[8])


with tempfile.TemporaryDirectory() as work:
    volume = metaimage(series, work)
    for step in steps:
        for look in looks:
            a, b = [], []
            for _ in range(rounds):
                a.append(our_time(step, look))
                b.append(their_time(step, look))
            x, y = statistics.median(a), statistics.median(b)
            print(f'step {step:g} voxel, {look:6}: {method} {x:.0f} ms, VTK {mapper} {y:.0f} ms, ratio {x / y:.2f}; in turns '
                  f'{" ".join(f"{p / q:.2f}" for p, q in zip(a, b))}', flush=True)
