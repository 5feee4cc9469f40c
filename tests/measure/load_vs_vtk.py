#!/usr/bin/python3
"""Time to load a DICOM folder, warm cache: angioscope's load (time_ms.load of `render --json`) against VTK's
vtkDICOMImageReader, in turns in one run. Usage: load_vs_vtk.py PROGRAM FOLDER [ROUNDS]"""
import json, os, statistics, subprocess, sys, tempfile, time
import vtk

program, folder = sys.argv[1:3]
rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 7
ours, theirs = [], []
with tempfile.TemporaryDirectory() as work:
    for turn in range(rounds + 1):
        text = subprocess.run([program, 'render', folder, '-o', os.path.join(work, 'x.pfm'), '--size', '8x8', '--step', '64',
                               '--mode', 'mip', '--quiet', '--json', '-'], check=True, capture_output=True).stdout
        load = json.loads(text)['time_ms']['load']
        start = time.perf_counter()
        reader = vtk.vtkDICOMImageReader()
        reader.SetDirectoryName(folder)
        reader.Update()
        other = 1e3 * (time.perf_counter() - start)
        if turn > 0:  # the first round warms the cache
            ours.append(load)
            theirs.append(other)
a, b = statistics.median(ours), statistics.median(theirs)
print(f'angioscope {a:.0f} ms ({min(ours):.0f}..{max(ours):.0f}), VTK {b:.0f} ms ({min(theirs):.0f}..{max(theirs):.0f}), '
      f'ratio {a / b:.2f}, medians of {rounds}')
