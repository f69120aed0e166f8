"""The table of a run: the least time of each row of `times` (mechanism, method, time, error if there is one)."""

import sys

least, errors = {}, {}
for line in open(sys.argv[1]):
    mechanism, method, time, *error = line.split()
    key = mechanism, method
    least[key] = min(least.get(key, float("inf")), float(time))
    if error:
        errors[key] = max(errors.get(key, 0.0), float(error[0]))

unit = least.pop(("unit", "sin_cos"))
print(f"\none sin_cos of f64: {unit:.1f} ns\n")
print("| mechanism | method | time [ns] | in sin_cos | over multipliers | over reduced | accelerations differ by |")
print("|---|---|---|---|---|---|---|")
for (mechanism, method), time in sorted(least.items(), key=lambda row: (row[0][0], row[1])):
    ratios = [
        f"{time / own:.1f}" if (own := least.get((mechanism, ours))) and (mechanism, method) in errors else ""
        for ours in ("multipliers", "reduced")
    ]
    error = errors.get((mechanism, method))
    error = "" if error is None else f"{error:.0e}"
    print(f"| {mechanism} | {method} | {time:.0f} | {time / unit:.0f} | {' | '.join(ratios)} | {error} |")
