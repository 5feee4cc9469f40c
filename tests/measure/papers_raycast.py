#!/usr/bin/python3
"""Repeats table 1 of Krueger & Westermann 2003 as rows of a Markdown table, and the choice of M.
Usage: papers_raycast.py PROGRAM NAME=FILE[,OPTION...]...
where options are those of render that the file needs, blanks as commas: aneurism=a.raw,--raw-dims,256x256x256.
Frames a second are the inverse of the least frame time over all rounds, in each of which all variants of a volume take
turns. One run, one machine: only ratios within a row count."""
import json, os, subprocess, sys, tempfile

program, volumes = sys.argv[1], sys.argv[2:]
work = tempfile.mkdtemp()
ROUNDS = 2
BRUTE = ['--no-skip', '--no-termination']
VARIANTS = {'SBVR': ['--method', 'slicing', '--bricks', '1x1x1', *BRUTE],
            'single pass': ['--method', 'singlepass', '--no-termination'],
            'RC': ['--method', 'raycast', *BRUTE],
            'RC-a': ['--method', 'raycast', '--no-skip'],
            'RC-b': ['--method', 'raycast', '--separate-passes'],
            'joined': ['--method', 'raycast']}


def render(given, *options):
    path, *own = given.split(',')
    text = subprocess.run([program, 'render', path, '-q', '-o', os.path.join(work, 'x.pfm'), '--backend', 'osmesa',
                           '--repeat', '1', '--orbit', '40', '--view', '30,20', '--zoom', '1.7', '--size', '512x512',
                           '--json', '-', *own, *options], check=True, capture_output=True, text=True).stdout
    return json.loads(text)


def best_of(given, variants, options):
    times, samples = {}, {}
    for _ in range(ROUNDS):
        for name, own in variants.items():
            j = render(given, *own, *options)
            times[name] = min(times.get(name, 1e30), j['time_ms']['frame_min'])
            samples[name] = j['counts']['samples']
    return times, samples


def table(shading):
    print(f'\nShading {shading}: frames a second; the share of samples taken\n')
    print('| volume | ' + ' | '.join(VARIANTS) + ' |')
    print('|---|' + '---|' * len(VARIANTS))
    for volume in volumes:
        name, given = volume.split('=', 1)
        times, samples = best_of(given, VARIANTS, ['--shading', shading])
        cells = [f"{1e3 / times[v]:.2f}" + (f' ({100 * samples[v] / samples["RC"]:.0f} %)' if v != 'SBVR' else '')
                 for v in VARIANTS]
        print(f'| {name} | ' + ' | '.join(cells) + ' |', flush=True)


def choice_of_m():
    name, given = volumes[0].split('=', 1)
    print(f'\nSteps a pass, {name}, without shading\n')
    print('| M | ' + ' | '.join(v for v in VARIANTS if v not in ('SBVR', 'single pass')) + ' |')
    print('|---|---|---|---|---|')
    for m in (8, 16, 32, 64):
        variants = {v: o + ['--passes-steps', str(m)] for v, o in VARIANTS.items() if v not in ('SBVR', 'single pass')}
        times, _ = best_of(given, variants, ['--shading', 'none'])
        print(f'| {m} | ' + ' | '.join(f'{1e3 / t:.2f}' for t in times.values()) + ' |', flush=True)


table('none')
choice_of_m()
table('phong')
