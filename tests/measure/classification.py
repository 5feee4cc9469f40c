#!/usr/bin/python3
"""Mid-point and prefix-integrated classification, as rows of Markdown tables: error against step and time for smooth,
kinked, step and spike transfer functions, and what prefix costs beside mid-point in every method.
Usage: classification.py PROGRAM PATH [render options]
The functions lie where vessels of a CT angiography do, 100 to 500 HU. Error: levels of 255 on premultiplied float RGBA
against --method reference, largest channel, without termination. Time: processor time of a frame on all threads, the
least of all rounds, in each of which both classifications take turns: one run, one machine, only ratios count."""
import json, math, os, resource, subprocess, sys, tempfile

program, path, given = sys.argv[1], sys.argv[2], sys.argv[3:]
work = tempfile.mkdtemp()
ROUNDS, FRAMES, STEPS = 3, 8, [2, 1, 0.5, 0.25]
RED, PALE = [0.8, 0.2, 0.1], [1, 0.9, 0.7]


def mix(t):
    return [round(a + t * (b - a), 4) for a, b in zip(RED, PALE)]


def smooth_points():
    """A raised cosine in 40 pieces, so that its kinks are far below what it does as a whole."""
    return [(100 + 400 * t / 40, mix(t / 40), 0.15 * (1 - math.cos(math.pi * t / 40))) for t in range(41)]


FUNCTIONS = {
    'smooth': smooth_points(),
    'kinked': [(200, RED, 0), (260, mix(0.3), 0.3), (320, mix(0.6), 0.05), (500, PALE, 0.1)],
    'step': [(250, RED, 0), (250, RED, 0.15), (350, mix(0.5), 0.15), (350, PALE, 0.3), (500, PALE, 0.3)],
    'spike': [(290, RED, 0), (300, RED, 0.95), (310, PALE, 0)],
}
METHODS = ['singlepass', 'envelope', 'raycast', 'slicing']


def run(*arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def preset(name):
    points = [{'hu': h, 'colour': c, 'opacity': o} for h, c, o in FUNCTIONS[name]]
    file = os.path.join(work, name + '.json')
    with open(file, 'w') as out:
        json.dump({'name': name, 'version': 1, 'modality': 'CTA', 'description': name, 'mode': 'dvr',
                   'shading': 'none', 'unit_distance': 1, 'window': {'centre': 300, 'width': 500}, 'points': points}, out)
    return file


def render(name, out, *options):
    return json.loads(run('render', path, '-q', '-o', os.path.join(work, out), '--preset', preset(name), '--background',
                          '0,0,0,0', '--no-termination', '--json', '-', *given, *options))


def error(out):
    return json.loads(run('check', os.path.join(work, out), os.path.join(work, 'truth.exr'), '--threshold', '255', '--json'))


def processor_ms(name, kind, frames, *options):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    render(name, f'{kind}.exr', '--classification', kind, '--repeat', str(frames), *options)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return 1e3 * (after.ru_utime - before.ru_utime)


def turns(name, *options):
    """Least processor times of a frame of both classifications: what further frames add to a run."""
    runs = {(kind, n): [] for kind in ('midpoint', 'prefix') for n in (1, 1 + FRAMES)}
    for _ in range(ROUNDS):
        for kind, n in runs:
            runs[kind, n].append(processor_ms(name, kind, n, *options))
    return {kind: (min(runs[kind, 1 + FRAMES]) - min(runs[kind, 1])) / FRAMES for kind in ('midpoint', 'prefix')}


def chosen(name, *options):
    j = render(name, 'auto.exr', *options)
    return 'prefix' if any('prefix-integrated' in u for u in j['plan']['uses']) else 'mid-point'


def errors():
    print('| function | step | mid-point: max | RMS | ms | prefix: max | RMS | ms | auto takes |')
    print('|---|---|---|---|---|---|---|---|---|')
    for name in FUNCTIONS:
        render(name, 'truth.exr', '--method', 'reference')
        for step in STEPS:
            best = turns(name, '--step', str(step))
            cells = []
            for kind in ('midpoint', 'prefix'):
                e = error(f'{kind}.exr')
                cells += [f"{e['max']:.3g}", f"{e['rms']:.3g}", f'{best[kind]:.0f}']
            print(f'| {name} | {step:g} | ' + ' | '.join(cells) + f" | {chosen(name, '--step', str(step))} |", flush=True)


def costs():
    print('\n| method | shading | mid-point ms | prefix ms | ratio |')
    print('|---|---|---|---|---|')
    for method in METHODS:
        for shading in ('none', 'phong'):
            best = turns('smooth', '--method', method, '--shading', shading)
            print(f"| {method} | {shading} | {best['midpoint']:.0f} | {best['prefix']:.0f} | "
                  f"{best['prefix'] / best['midpoint']:.2f} |", flush=True)


errors()
costs()
