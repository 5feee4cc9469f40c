#!/usr/bin/python3
"""Repeats the figures of the slicing papers as rows of Markdown tables.
Usage: papers_slicing.py PROGRAM rezk-salama PHANTOM      (figures 4 and 5; a phantom of 512x512x96)
       papers_slicing.py PROGRAM benassarou PHANTOM106    (figure 4; a phantom of 512x512x106)
Frames per second are the inverse of the median frame time. One run, one machine: only ratios within it count."""
import json, os, subprocess, sys, tempfile

program, what, path = sys.argv[1:4]
work = tempfile.mkdtemp()


def render(*options, repeat=2):
    text = subprocess.run([program, 'render', path, '-q', '-o', os.path.join(work, 'x.pfm'), '--method', 'slicing',
                           '--backend', 'osmesa', '--no-termination', '--passes-steps', '1', '--repeat', str(repeat),
                           '--orbit', '90', '--view', '30,20', '--zoom', '1.7', '--json', '-', *options],
                          check=True, capture_output=True, text=True).stdout
    return json.loads(text)


def transparent_below(share):
    """Transparent below a share of the range of values, as in the paper."""
    low, high = json.loads(subprocess.run([program, 'info', path, '--json'], check=True, capture_output=True,
                                          text=True).stdout)['input']['hu_range']
    start = low + share * (high - low)
    name = os.path.join(work, f'below-{share:.2f}.json')
    points = [[low, .5, .1, .1, 0], [start, .6, .2, .1, 0], [start + 1, .6, .2, .1, .02], [high, 1, .9, .8, .6]]
    json.dump({'name': 'paper', 'unit_mm': 1.0, 'points': points}, open(name, 'w'))
    return name


def rezk_salama():
    bricks = ['2x2x1', '4x4x2', '8x8x4', '16x16x4', '16x16x8', '32x32x8', '64x64x8', '64x64x16']
    print('| bricks | plain, below 1/3 | plain, below 1/2 | Phong, below 1/3 | Phong, below 1/2 | bricks drawn | polygons |')
    print('|---|---|---|---|---|---|---|')
    base = {}
    for b in ['1x1x1'] + bricks + ['octree, where it pays']:
        cells, counts = [], None
        for shading in ('none', 'phong'):
            for share in (1 / 3, 1 / 2):
                options = ['--preset', transparent_below(share), '--shading', shading, '--size', '512x512']
                if b == '1x1x1':
                    options.append('--no-skip')
                if 'x' in b and b[0].isdigit():
                    options += ['--bricks', b]
                j = render(*options)
                fps = 1e3 / j['time_ms']['frame_median']
                counts = j['counts']
                base.setdefault((shading, share), fps)
                cells.append(f'{fps:.2f} ({100 * (fps / base[shading, share] - 1):+.0f} %)')
        print(f'| {b} | ' + ' | '.join(cells) + f" | {counts['boxes']} | {counts['polygons']} |", flush=True)


def benassarou():
    proxies = ['convex-hull', 'marching-tetrahedra', 'marching-cubes', 'vertex-program']
    print('| rate | planes | ' + ' | '.join(proxies) + ' |')
    print('|---|---|' + '---|' * len(proxies))
    for rate in (1, 2, 4, 8, 16):
        cells, planes = [], 0
        for proxy in proxies:
            j = render('--mode', 'dvr', '--shading', 'none', '--preset', transparent_below(1 / 3), '--no-skip', '--bricks',
                       '1x1x1', '--size', '704x576', '--step', str(1 / rate), '--proxy', proxy, repeat=1)
            cells.append(f"{1e3 / j['time_ms']['frame_median']:.3f}")
            planes = j['counts']['polygons']
        print(f'| {rate}x | {planes} | ' + ' | '.join(cells) + ' |', flush=True)


{'rezk-salama': rezk_salama, 'benassarou': benassarou}[what]()
