// Listing 1 over columns, as one writes it in C for a compiler that turns loops into vector instructions.
//
// listing COLUMNS THRESHOLDS ROUNDS: reads slices of nine columns of floats, writes the thresholds of the first slice,
// and prints the fastest and the middle round in nanoseconds a threshold. Every round has another slice, read once before
// the clock starts, as hashed_alpha::cost::clock does it.
#define _GNU_SOURCE
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define SLICE 8192

static float hash_2d(float x, float y) {
    float value = 1.0e4f * sinf(17.0f * x + 0.1f * y) * (0.1f + fabsf(sinf(13.0f * y + x)));
    return value - floorf(value);
}

static float hash_3d(float x, float y, float z) { return hash_2d(hash_2d(x, y), z); }

__attribute__((noinline)) static void thresholds(const float *restrict in, float *restrict out) {
    const float *px = in, *py = px + SLICE, *pz = py + SLICE, *ax = pz + SLICE, *ay = ax + SLICE, *az = ay + SLICE,
                *bx = az + SLICE, *by = bx + SLICE, *bz = by + SLICE;
    for (int i = 0; i < SLICE; i++) {
        float a2 = ax[i] * ax[i] + ay[i] * ay[i] + az[i] * az[i], b2 = bx[i] * bx[i] + by[i] * by[i] + bz[i] * bz[i];
        float log_scale = log2f(1.0f / sqrtf(a2 > b2 ? a2 : b2));
        float low = floorf(log_scale), t = log_scale - low;
        float s = exp2f(low), u = exp2f(ceilf(log_scale));
        float coarse = hash_3d(floorf(s * px[i]), floorf(s * py[i]), floorf(s * pz[i]));
        float fine = hash_3d(floorf(u * px[i]), floorf(u * py[i]), floorf(u * pz[i]));
        float x = (1.0f - t) * coarse + t * fine, a = t < 1.0f - t ? t : 1.0f - t;
        float edge = x < 1.0f - a ? x : 1.0f - x;
        float outer = edge * edge / (2.0f * a * (1.0f - a)), middle = (x - 0.5f * a) / (1.0f - a);
        float value = x < a ? outer : x < 1.0f - a ? middle : 1.0f - outer;
        value = value < 1.0e-6f ? 1.0e-6f : value;
        out[i] = value > 1.0f ? 1.0f : value;
    }
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv) {
    if (argc != 4) return 2;
    FILE *file = fopen(argv[1], "rb");
    int rounds = atoi(argv[3]), slices = 0;
    float *columns = NULL, *out = malloc(SLICE * sizeof(float));
    const size_t size = 9 * SLICE;
    for (;;) {
        columns = realloc(columns, (slices + 1) * size * sizeof(float));
        if (fread(columns + slices * size, sizeof(float), size, file) != size) break;
        slices++;
    }
    thresholds(columns, out);
    file = fopen(argv[2], "wb");
    fwrite(out, sizeof(float), SLICE, file);
    fclose(file);
    double *times = malloc(rounds * sizeof(double));
    volatile float sink = 0;
    for (int round = 0; round < rounds; round++) {
        const float *slice = columns + (round % slices) * size;
        for (size_t i = 0; i < size; i++) sink += slice[i];
        struct timespec start, end;
        clock_gettime(CLOCK_MONOTONIC, &start);
        thresholds(slice, out);
        clock_gettime(CLOCK_MONOTONIC, &end);
        sink += out[round % SLICE];
        times[round] = ((end.tv_sec - start.tv_sec) * 1e9 + (end.tv_nsec - start.tv_nsec)) / SLICE;
    }
    qsort(times, rounds, sizeof(double), by_size);
    printf("%f %f\n", times[0], times[rounds / 2]);
    return 0;
}
