#!/usr/bin/python3
"""fit_decision.py DUMP.csv... : fits the weights of the decision (recognition/decision_weights.h) by logistic regression.

Each DUMP.csv is what `evaluate --dump` wrote: one judged candidate a line, with its evidence and its error. Fitted are
those that no better one suppressed, as the decision is made on them; with --suppressed all of them. A candidate is right when its MSPD is below 10 px. Prints the weights (the `decision:` block of the recogniser's
options), how well probability and truth agree, and found/right trade-offs. With --holdout COLUMN the fit is repeated
with each value of that column left out and the held-out candidates are reported.
"""
import argparse
import csv
import math

import numpy as np

NAMES = ['log_sum', 'mean', 'hit_ratio', 'silhouette_hits', 'crease_hits', 'log_groups', 'unsupported',
         'unsupported_length', 'continuation', 'overhang', 'interior', 'solidity', 'log_faces', 'log_size',
         'log_contrast', 'in_frame', 'rms']


def feature(row, name):
    if name.startswith('log_'):
        floor = {'log_sum': 1.0, 'log_groups': 1.0, 'log_size': 1.0, 'log_faces': 1.0,
                 'log_contrast': 0.1}[name]
        return math.log(max(float(row[name[4:]]), floor))
    return min(float(row[name]), 0.5) if name == 'interior' else float(row[name])


def read(paths, suppressed):
    rows = []
    for path in paths:
        with open(path, newline='') as f:
            for row in csv.DictReader(f):
                if row.get('fate') == 'suppressed' and not suppressed:
                    continue
                row['file'] = path
                rows.append(row)
    x = np.array([[feature(r, n) for n in NAMES] for r in rows])
    y = np.array([float(r['mspd_px'] or 'inf') < 10 for r in rows], float)
    return rows, x, y


def fit(x, y, ridge=3.0):
    """Ridge logistic regression by Newton's method on standardised columns; returns (bias, weights) in the original scale."""
    mean, scale = x.mean(0), x.std(0) + 1e-9
    a = np.c_[np.ones(len(x)), (x - mean) / scale]
    w = np.zeros(a.shape[1])
    penalty = ridge * np.r_[0, np.ones(a.shape[1] - 1)]
    for _ in range(50):
        p = 1 / (1 + np.exp(-np.clip(a @ w, -30, 30)))
        h = (a * (p * (1 - p))[:, None]).T @ a + np.diag(penalty)
        step = np.linalg.solve(h, a.T @ (y - p) - penalty * w)
        w += step
        if np.abs(step).max() < 1e-9:
            break
    weights = w[1:] / scale
    return w[0] - weights @ mean, weights


def auc(p, y):
    order = np.argsort(p)
    ranks = np.empty(len(p))
    ranks[order] = np.arange(1, len(p) + 1)
    n1, n0 = y.sum(), (1 - y).sum()
    return (ranks[y == 1].sum() - n1 * (n1 + 1) / 2) / max(n1 * n0, 1)


def report(p, y, title):
    print(f'{title}: {len(y)} candidates, {int(y.sum())} right, AUC {auc(p, y):.4f}')
    for low, high in ((0, .1), (.1, .3), (.3, .5), (.5, .7), (.7, .9), (.9, 1.01)):
        m = (p >= low) & (p < high)
        if m.any():
            print(f'  probability {low:.1f}-{min(high, 1):.1f}: {m.sum():5d} candidates, mean {p[m].mean():.3f}, right {y[m].mean():.3f}')
    for t in (.3, .4, .5, .6, .7):
        m = p >= t
        print(f'  accept at {t:.1f}: {int(y[m].sum())} right of {m.sum()} ({y[m].mean() if m.any() else 0:.3f})')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('dumps', nargs='+')
    parser.add_argument('--holdout', help='column whose values are left out in turn, e.g. scene_id')
    parser.add_argument('--ridge', type=float, default=3.0)
    parser.add_argument('--suppressed', action='store_true', help='fit the suppressed candidates, too')
    args = parser.parse_args()
    rows, x, y = read(args.dumps, args.suppressed)
    bias, w = fit(x, y, args.ridge)
    print('decision:\n  bias: %.3f' % bias)
    for n, v in zip(NAMES, w):
        print('  %s: %.3f' % (n, v))
    p = 1 / (1 + np.exp(-(x @ w + bias)))
    report(p, y, 'all')
    for scene in sorted({r['scene_id'] for r in rows}):
        m = np.array([r['scene_id'] == scene for r in rows])
        report(p[m], y[m], f'scene {scene}')
    if args.holdout:
        q = np.zeros(len(y))
        for value in sorted({r[args.holdout] for r in rows}):
            m = np.array([r[args.holdout] == value for r in rows])
            b, v = fit(x[~m], y[~m], args.ridge)
            q[m] = 1 / (1 + np.exp(-(x[m] @ v + b)))
        report(q, y, f'held out by {args.holdout}')


if __name__ == '__main__':
    main()
