"""Writes the tables of this folder: p-values of high precision, for tests/references.rs.

Needs Python 3 and mpmath; takes some minutes. Each row is `function,parameters,reference`: parameters are f64 or
whole numbers separated by spaces, and the reference belongs to exactly these f64, not to the decimals they stand for.
Every formula is a definition or a series of positive terms, in enough digits for what cancels; none is shared with the
crate.
"""

import itertools
import math
import operator
from pathlib import Path

from mpmath import binomial, erfc, erfinv, exp, findroot, log, log1p, loggamma, mp, mpf, sqrt

mp.dps = 40


# Sums of a falling series.


def falling(first, ratio):
    """first (1 + ratio(0) (1 + ratio(1) (...)))"""
    total = term = first
    for i in itertools.count():
        term *= ratio(i)
        if term <= total * mp.eps:
            return total
        total += term


# Laws. Each gives a tail that is summed, never a complement, unless the digits are there.


def binomial_pmf(k, n, q):
    return exp(loggamma(n + 1) - loggamma(k + 1) - loggamma(n - k + 1) + k * log(q) + (n - k) * log1p(-q))


def binomial_upper(k, n, q):
    q = mpf(q)
    if k <= n * q:
        return 1 - binomial_lower(k - 1, n, q) if k > 0 else mpf(1)
    return falling(binomial_pmf(k, n, q), lambda i: mpf(n - k - i) / (k + i + 1) * q / (1 - q))


def binomial_lower(k, n, q):
    q = mpf(q)
    if k >= n * q:
        return 1 - binomial_upper(k + 1, n, q) if k < n else mpf(1)
    return falling(binomial_pmf(k, n, q), lambda i: mpf(k - i) / (n - k + i + 1) * (1 - q) / q)


def poisson_pmf(k, mean):
    return exp(k * log(mpf(mean)) - mpf(mean) - loggamma(k + 1))


def poisson_upper(k, mean):
    if k <= mean:
        return 1 - poisson_lower(k - 1, mean) if k > 0 else mpf(1)
    return falling(poisson_pmf(k, mean), lambda i: mpf(mean) / (k + i + 1))


def poisson_lower(k, mean):
    if k >= mean:
        return 1 - poisson_upper(k + 1, mean)
    return falling(poisson_pmf(k, mean), lambda i: mpf(k - i) / mpf(mean))


def gamma_lower(a, x):
    """Regularized; a series of positive terms."""
    return falling(exp(a * log(x) - x - loggamma(a + 1)), lambda i: x / (a + i + 1))


def gamma_upper(a, x):
    return 1 - gamma_lower(a, x)


def chi_square_upper(x, dof):
    with mp.workdps(360 if x > dof else 40):
        return +gamma_upper(mpf(dof) / 2, mpf(x) / 2)


def chi_square_lower(x, dof):
    return gamma_lower(mpf(dof) / 2, mpf(x) / 2)


def beta_lower(a, b, x):
    """Regularized incomplete beta; a series of positive terms, or its complement where that converges faster."""
    if x > 0.5:
        return 1 - beta_lower(b, a, 1 - x)
    first = exp(a * log(x) + b * log1p(-x) + loggamma(a + b) - loggamma(a + 1) - loggamma(b))
    return falling(first, lambda i: (a + b + i) / (a + i + 1) * x)


def f_upper(f, above, below):
    f, above, below = mpf(f), mpf(above), mpf(below)
    with mp.workdps(360):
        return beta_lower(below / 2, above / 2, below / (above * f + below))


def f_lower(f, above, below):
    f, above, below = mpf(f), mpf(above), mpf(below)
    with mp.workdps(360):
        return beta_lower(above / 2, below / 2, above * f / (above * f + below))


def student(t, dof):
    return f_upper(mpf(t) ** 2, 1, dof)


def root(f, low, high):
    return findroot(f, (mpf(low), mpf(high)), solver="illinois", tol=1e-28, maxsteps=300, verify=False)


def clopper_pearson(k, n, alpha, end):
    share, half = mpf(k) / n, mpf(alpha) / 2
    if end == 0:
        return root(lambda q: log(binomial_upper(k, n, q) / half), share / 10**12, share)
    return root(lambda q: log(binomial_lower(k, n, q) / half), share, 1 - (1 - share) / 10**9)


def kolmogorov_bulk(d, n):
    """Marsaglia, Tsang and Wang 2003: one row of the n-th power of their matrix, in fixed point."""
    point = 250
    with mp.workdps(90):
        d = mpf(d)
        k = int(mp.ceil(n * d))
        h = k - n * d
        size = 2 * k - 1
        matrix = [[mpf(i - j + 1 >= 0) for j in range(size)] for i in range(size)]
        for i in range(size):
            matrix[i][0] -= h ** (i + 1)
            matrix[size - 1][i] -= h ** (size - i)
        matrix[size - 1][0] += (2 * h - 1) ** size if 2 * h > 1 else 0
        fixed = lambda i, j: int(matrix[i][j] / mp.factorial(max(i - j + 1, 0)) * 2**point)
        columns = [[fixed(i, j) for i in range(size)] for j in range(size)]
        row = [int(i == k - 1) << point for i in range(size)]
        for _ in range(n):
            row = [sum(map(operator.mul, row, column)) >> point for column in columns]
        return 1 - mpf(row[k - 1]) / 2**point * mp.factorial(n) / mpf(n) ** n


def kolmogorov_tail(d, n):
    """Twice Smirnov's one-sided formula; both sides together are less than exp(-6 n d^2) of it."""
    d = mpf(d)
    with mp.workdps(25):
        return 2 * d * mp.fsum(
            exp(loggamma(n + 1) - loggamma(j + 1) - loggamma(n - j + 1) + (n - j) * log1p(-d - mpf(j) / n) + (j - 1) * log(d + mpf(j) / n))
            for j in range(int(mp.floor(n * (1 - d))) + 1) if d + mpf(j) / n < 1
        )


def kolmogorov(d, n):
    return kolmogorov_tail(d, n) if n * d * d > 4.5 else kolmogorov_bulk(d, n)


def kolmogorov_limit(z):
    z = mpf(z)
    with mp.workdps(60):
        return 2 * mp.fsum((-1) ** (k - 1) * exp(-2 * k * k * z * z) for k in range(1, 200))


def two_sample(distance, m, n):
    """Merges are lattice paths; those that stay inside the band are counted."""
    inside = [0] * (n + 1)
    for i in range(m + 1):
        for j in range(n + 1):
            if abs(i * n - j * m) >= distance:
                inside[j] = 0
            elif i == j == 0:
                inside[j] = 1
            else:
                inside[j] = (inside[j] if i else 0) + (inside[j - 1] if j else 0)
    every = math.comb(m + n, n)
    with mp.workdps(30):
        return mpf(every - inside[n]) / every


def fisher_g(g, n):
    """Terms are at most e^30 here, and none counts after 400."""
    with mp.workdps(360):
        g = mpf(g)
        return mp.fsum((-1) ** (j + 1) * binomial(n, j) * (1 - j * g) ** (n - 1) for j in range(1, min(n, 400) + 1) if j * g < 1)


def collisions(observed, n, urns):
    """The numbers of values thrown so far that met a full urn, as whole numbers over urns^n."""
    ways = {0: 1}
    for thrown in range(n):
        after = {}
        for c, w in ways.items():
            full = thrown - c
            after[c] = after.get(c, 0) + w * (urns - full)
            after[c + 1] = after.get(c + 1, 0) + w * full
        ways = after
    every = urns**n
    lower = mpf(sum(w for c, w in ways.items() if c <= observed)) / every
    upper = mpf(sum(w for c, w in ways.items() if c >= observed)) / every
    return lower, upper


def noncentrality(dof, alpha, power):
    x = root(lambda x: log(chi_square_upper(x, dof) / mpf(alpha)), dof + 0.1, 2 * dof + 200)
    a = mpf(dof) / 2

    def upper(lam):
        # P(chi-square of dof + 2j >= x) grows by a Poisson-like term with each j.
        total, tail = mpf(0), gamma_upper(a, x / 2)
        step = exp(a * log(x / 2) - x / 2 - loggamma(a + 1))
        weight, j = exp(-lam / 2), 0
        while j < lam or weight > mpf(10) ** -35:
            total += weight * tail
            tail += step
            j += 1
            step *= x / 2 / (a + j)
            weight *= lam / 2 / j
        return total

    return root(lambda lam: upper(lam) - mpf(power), 1, 2000)


# Tables.


def write(name, rows):
    lines = ["function,parameters,reference"]
    for function, parameters, reference in rows:
        if mpf("1e-305") < reference:
            lines.append(f"{function},{' '.join(map(repr, parameters))},{mp.nstr(reference, 17, strip_zeros=False)}")
    Path(__file__).with_name(f"{name}.csv").write_text("\n".join(lines) + "\n")
    print(name, len(lines) - 1, flush=True)


def normal_rows():
    for z in [0.0, 1e-9, 0.1, 0.5, 1.0, 2.0, 3.0, 4.5, 6.0, 8.0, 12.0, 20.0, 30.0, 36.5, 37.0]:
        yield "normal.two_sided_p", [z], erfc(mpf(z) / sqrt(2))
        yield "normal.upper_p", [z], erfc(mpf(z) / sqrt(2)) / 2
        yield "normal.upper_p", [-z], erfc(-mpf(z) / sqrt(2)) / 2
    for p in [0.7, 0.9, 0.999, 1 - 1e-9, 0.51]:
        yield "normal.quantile", [p], sqrt(2) * erfinv(2 * mpf(p) - 1)
    for p in [0.3, 0.05, 1e-3, 1e-6, 1e-9, 1e-12, 1e-30, 1e-100, 1e-200, 1e-300]:
        yield "normal.minus_quantile", [p], root(lambda z: log(erfc(z / sqrt(2)) / 2 / mpf(p)), 0, 40)


def binomial_rows():
    for n, q in [(1, 0.3), (10, 0.5), (100, 0.25), (1000, 0.001), (10_000, 0.5), (65_536, 1 / 3), (1_000_000, 4.2e-4), (1_000_000, 0.5), (1_000_000, 0.999)]:
        mean, sigma = n * q, math.sqrt(n * q * (1 - q))
        counts = {round(mean + z * sigma) for z in [-37, -20, -10, -6, -3, -1, -0.2, 0, 0.2, 1, 3, 6, 10, 20, 37]} | {0, n}
        for k in sorted(k for k in counts if 0 <= k <= n):
            yield "binomial.upper_p", [k, n, q], binomial_upper(k, n, q)
            yield "binomial.lower_p", [k, n, q], binomial_lower(k, n, q)
    for mean in [0.001, 0.5, 2.5, 64.0, 1000.0, 1e6]:
        sigma = math.sqrt(mean)
        for k in sorted({max(0, round(mean + z * sigma)) for z in [-37, -20, -10, -6, -3, -1, 0, 1, 3, 6, 10, 20, 37]} | {0, 1, 5, 20, 100}):
            yield "binomial.poisson_upper_p", [k, mean], poisson_upper(k, mean)
            yield "binomial.poisson_lower_p", [k, mean], poisson_lower(k, mean)
    for k, n, alpha in [(3, 10, 0.05), (1, 10, 1e-3), (9, 10, 1e-6), (500, 1000, 0.01), (420, 1_000_000, 1e-6), (420, 1_000_000, 1e-12), (499_000, 1_000_000, 1e-9)]:
        yield "binomial.clopper_pearson.low", [k, n, alpha], clopper_pearson(k, n, alpha, 0)
        yield "binomial.clopper_pearson.high", [k, n, alpha], clopper_pearson(k, n, alpha, 1)


def chi_square_rows():
    for dof in [1, 2, 3, 7, 15, 63, 64, 225, 255, 1023, 4095, 65_535]:
        xs = {dof * 0.5, dof * 0.9, float(dof), dof * 1.1, dof + 10.0, dof + 6 * math.sqrt(2 * dof), dof * 1.5, dof * 2.0 + 30, dof * 3.0 + 200, dof + 1300.0}
        xs |= {dof - 6 * math.sqrt(2 * dof), dof - 3 * math.sqrt(2 * dof), dof * 0.1, dof * 0.01, 1e-6}
        for x in sorted(x for x in xs if x > 0):
            yield "chi_square.upper_p", [x, dof], chi_square_upper(x, dof)
            if x < 2 * dof + 100:
                yield "chi_square.lower_p", [x, dof], chi_square_lower(x, dof)


def beta_rows():
    for above, below in [(1, 1), (1, 5), (2, 3), (7, 30), (63, 63), (255, 1000), (4095, 4095), (65_535, 20_001), (1_000_000, 300_000)]:
        spread = math.sqrt(2 / above + 2 / below)
        for f in sorted({math.exp(z * spread) for z in [-25, -10, -6, -3, -1, -0.1, 0, 0.1, 1, 3, 6, 10, 25]}):
            if 1e-6 < f < 1e6:
                yield "beta.f_upper", [f, above, below], f_upper(f, above, below)
                yield "beta.f_lower", [f, above, below], f_lower(f, above, below)
    for dof in [1, 2, 5, 30, 1000, 100_000]:
        for t in [1e-3, 0.5, 1.0, 3.0, 6.0, 20.0, 36.0, 1e4]:
            yield "beta.student_two_sided_p", [t, dof], student(t, dof)


def kolmogorov_rows():
    for n in [1, 2, 5, 10, 37, 100, 400, 1000]:
        for z in [0.3, 0.5, 0.7, 0.9, 1.2, 1.6, 1.9, 2.0]:
            d = z / math.sqrt(n)
            if 0.5 / n < d < 1:
                yield "ecdf.upper_p", [d, n], kolmogorov(d, n)
    for n in [10, 100, 1000, 10_000, 100_000]:
        for z in [2.2, 3.0, 4.5, 8.0, 15.0, 18.0]:
            d = z / math.sqrt(n)
            if d < 1:
                yield "ecdf.upper_p", [d, n], kolmogorov(d, n)
    for z in [0.2, 0.3, 0.5, 0.8, 0.99, 1.0, 1.3, 2.0, 3.0, 5.0, 10.0, 18.0]:
        yield "ecdf.limit_upper_p", [z], kolmogorov_limit(z)
    for m, n in [(1, 1), (5, 3), (20, 20), (60, 45), (300, 211), (250, 250), (40, 500)]:
        gcd = math.gcd(m, n)
        for z in [0.3, 0.6, 0.9, 1.3, 2.0, 3.5, 6.0, 10.0, 16.0]:
            distance = round(z * math.sqrt(m * n * (m + n)) / gcd) * gcd
            if 0 < distance <= m * n:
                yield "two_sample.upper_p", [distance, m, n], two_sample(distance, m, n)


def fisher_rows():
    for n in [2, 5, 16, 17, 30, 100, 500, 2000, 32_640]:
        for expected in [30.0, 10.0, 4.0, 2.1, 1.9, 0.5, 0.01, 1e-6, 1e-12, 1e-50, 1e-290]:
            g = -math.expm1(math.log(expected / n) / (n - 1))
            if 1.0 / n < g < 1.0:
                yield "fisher_g.upper_p", [g, n], fisher_g(g, n)


def collision_rows():
    for n, urns in [(5, 3), (30, 40), (100, 1000), (100, 17), (300, 10_000)]:
        for observed in sorted({0, 1, 3, 4, 7, 12, 20, 29, 50, 90} & set(range(n))):
            lower, upper = collisions(observed, n, urns)
            if lower > 0:
                yield "collisions.lower", [observed, n, urns], lower
            yield "collisions.upper", [observed, n, urns], upper


def power_rows():
    for dof, alpha, power in [(1, 1e-9, 0.999), (15, 1e-6, 0.999), (63, 1e-9, 0.5), (63, 1e-9, 0.999), (255, 1e-12, 0.9), (1023, 1e-9, 0.999)]:
        yield "power.noncentrality", [dof, alpha, power], noncentrality(dof, alpha, power)


if __name__ == "__main__":
    write("normal", normal_rows())
    write("chi_square", chi_square_rows())
    write("fisher_g", fisher_rows())
    write("collisions", collision_rows())
    write("power", power_rows())
    write("beta", beta_rows())
    write("kolmogorov", kolmogorov_rows())
    write("binomial", binomial_rows())
