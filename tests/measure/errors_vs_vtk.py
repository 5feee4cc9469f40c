#!/usr/bin/python3
"""Errors of cpu's pictures and of VTK's CPU mapper at the same step, camera and transfer function, in levels of 255, RMS and
largest of all pixels and colours of three views: both against --method reference; VTK against its own pictures at finer
steps (its light is another, so that the reference is no truth for it when shaded); and what VTK's window shows
of it, 8 bits and interpolated. Usage: errors_vs_vtk.py PROGRAM SERIES BENCH [SIDE] [STEPS] [LOOKS] [KEEP], lists as for
method_vs_vtk.py; KEEP is a folder for the pictures; for BENCH see beside_vtk.py. Also needs python3-pil."""
import json, os, subprocess, sys, tempfile
import numpy as np
from PIL import Image
from beside_vtk import metaimage, ours, points, preset, theirs

program, series, bench = sys.argv[1:4]
side = int(sys.argv[4]) if len(sys.argv) > 4 else 192
size = f'{side}x{side}'
steps = [float(x) for x in (sys.argv[5] if len(sys.argv) > 5 else '0.5,1').split(',')]
looks = (sys.argv[6] if len(sys.argv) > 6 else 'plain,shaded,tissue,mip').split(',')
views = 0, 120, 240  # azimuths, all at elevation 20
finer = 4, 8, 16     # of a voxel


def our_picture(look, azimuth, method, step):
    path = os.path.join(work, f'{look}-{azimuth}-{method}-{step}.pfm')
    subprocess.run(
        ours(program, series, preset(bench, look, work), look, size) +
        ['-o', path, '--method', method, '--view', f'{azimuth},20', '--step', str(step)], check=True)
    pixels = open(path, 'rb').read()[-12 * side * side:]  # floats from the bottom row up, after a header
    return 255 * np.frombuffer(pixels, '<f4').reshape(side, side, 3)[::-1]


def their_points(look):
    """VTK multiplies colour by opacity in projections too: with an opacity of 1 it shows the ramp, as we do."""
    if look != 'mip':
        return points(bench, look)
    path = os.path.join(work, 'opaque.json')
    made = json.load(open(points(bench, look)))
    made['points'] = [point[:4] + [1] for point in made['points']]
    json.dump(made, open(path, 'w'))
    return path


def their_picture(look, azimuth, step):
    """Of the rays, and of the window."""
    path = os.path.join(work, f'{look}-{azimuth}-vtk-{step}.png')
    rays = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'vtk_rays.py')
    subprocess.run(
        theirs(bench, volume, their_points(look), look, size, step, 'cpu', [rays]) + ['--az', str(azimuth), '--png', path],
        check=True, capture_output=True)
    return 255 * np.load(path + '.npy')[..., :3], np.asarray(Image.open(path).convert('RGB')).astype(float)


def error(pictures, truths):
    off = np.stack(pictures) - np.stack(truths)
    return f'{np.sqrt((off * off).mean()):.2f} / {np.abs(off).max():.1f}'


with tempfile.TemporaryDirectory() as work:
    if len(sys.argv) > 7:
        work = sys.argv[7]
        os.makedirs(work, exist_ok=True)
    volume = metaimage(series, work)
    for look in looks:
        truth = [our_picture(look, a, 'reference', steps[0]) for a in views]
        fine = {n: [their_picture(look, a, 1 / n)[0] for a in views] for n in finer}
        for n, pictures in fine.items():
            print(f'{look:6} 1/{n:2} voxel: VTK {error(pictures, truth)}', flush=True)
        for step in steps:
            cpu = [our_picture(look, a, 'cpu', step) for a in views]
            rays, window = zip(*(their_picture(look, a, step) for a in views))
            print(
                f'{look:6} {step:g} voxel: cpu {error(cpu, truth)}, VTK {error(rays, truth)}, its window {error(window, truth)}; '
                f'VTK beside its own {", ".join(f"1/{n} {error(rays, fine[n])}" for n in finer)}; mean level cpu '
                f'{np.mean(cpu):.1f}, VTK {np.mean(rays):.1f}', flush=True)
