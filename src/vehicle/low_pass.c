/* SPDX-License-Identifier: BSD-2-Clause */
#include "vehicle/low_pass.h"

#include <math.h>

#define PI 3.14159265358979323846

typedef struct filter {
    double b0, b1, b2, a1, a2;
} filter;

static filter butterworth(double cut_off, double step)
{
    double k = tan(PI * cut_off * step), norm = 1.0 / (1.0 + sqrt(2.0) * k + k * k);
    return (filter){.b0 = k * k * norm,
                    .b1 = 2.0 * k * k * norm,
                    .b2 = k * k * norm,
                    .a1 = 2.0 * (k * k - 1.0) * norm,
                    .a2 = (1.0 - sqrt(2.0) * k + k * k) * norm};
}

/* From x[first] on in steps of way, n samples; before it everything was x[first]. */
static void run(const filter *f, int n, int first, int way, double *x)
{
    double x1 = x[first], x2 = x1, y1 = x1, y2 = x1;
    for (int i = 0; i < n; i++) {
        double *now = &x[first + i * way], x0 = *now;
        double y = f->b0 * x0 + f->b1 * x1 + f->b2 * x2 - f->a1 * y1 - f->a2 * y2;
        x2 = x1;
        x1 = x0;
        y2 = y1;
        y1 = y;
        *now = y;
    }
}

void gm_low_pass(double cut_off, double step, int n, double *x)
{
    filter f = butterworth(cut_off, step);
    if (n < 1)
        return;
    run(&f, n, 0, 1, x);
    run(&f, n, n - 1, -1, x);
}
