/* The loop of bench_effects.py in plain C: axes that each have ten play operators, creep, friction
 * and a further mode, computed as sim/effects and sim/plant do it, with nothing called through a
 * pointer. Built with -O3. */

#include <math.h>

enum { PLAYS = 10, TERMS = 12 };

static double plays(double x, const double *p, double *s)
{
    x -= p[0];
    double y = p[1] * x;
    for (int i = 0; i < PLAYS; i++) {
        double low = x - p[2 + i], high = x + p[2 + i];
        double held = s[i] < high ? s[i] : high;
        s[i] = held > low ? held : low;
        y += p[2 + PLAYS + i] * s[i];
    }
    return p[0] + y;
}

static double creep(double x, double h, const double *p, double *s)
{
    double *start = s + TERMS, *lasted = start + 1, *moved = start + 2, *mean = moved + TERMS;
    double y = x;
    if (fabs(h - *lasted) > 1e-9 * h) {
        *lasted = h;
        for (int i = 0; i < TERMS; i++) {
            moved[i] = -expm1(-h / p[i]);
            mean[i] = 1.0 - moved[i] * p[i] / h;
        }
    }
    for (int i = 0; i < TERMS; i++) {
        double way = x - s[i];
        y += p[TERMS + i] * (s[i] + mean[i] * way - *start);
        s[i] += moved[i] * way;
    }
    return y;
}

static double friction(double v, double b, const double *p)
{
    double dry = v > 0.0 ? p[0] : p[1], viscous = v > 0.0 ? p[4] : p[5];
    double speed = fabs(v), most = dry * p[2];
    if (speed <= b * most)
        return -v / b;
    double left = (speed - b * most) / (1.0 + b * viscous);
    if (p[2] > 1.0)
        for (int i = 0; i < 3; i++) {
            double ratio = left / p[3];
            most = dry * (1.0 + (p[2] - 1.0) * exp(-ratio * ratio));
            left = (speed - b * most) / (1.0 + b * viscous);
        }
    double force = most + viscous * left;
    return v > 0.0 ? -force : force;
}

/* Rows of `rows` samples, each followed by `parts` steps of its interval `hold`. For each axis
 * numbers_at and memory_at hold where those of its three functions begin. */
void run(long rows, long parts, double hold, long axes, const long *place, const long *rate,
         const double *asked, const double *offset, const long *numbers_at, const long *memory_at,
         const double *numbers, double *memory, long groups, const long *first, const long *states,
         const long *size, const long *member_at, const long *member, const long *within_at,
         const double *within, const long *into_at, const double *into, const long *begin,
         const long *end, const long *term, const double *weight, const double *inputs,
         double *position, double *velocity, double *reading, double *x, double *fresh, double *u)
{
    long total = first[groups - 1] + states[groups - 1];
    for (long k = 0; k < rows; k++) {
        for (long i = 0; i < axes; i++) {
            double q = 0.0;
            for (long t = begin[i]; t < end[i]; t++)
                q += weight[t] * x[term[t]];
            position[k * axes + i] = q;
            reading[k * axes + i] = q + offset[i];
            velocity[k * axes + i] = x[rate[i]];
        }
        if (k == rows - 1)
            break;
        for (long i = 0; i < axes; i++) {
            double w = asked[i] * inputs[k * axes + i];
            w = plays(w, numbers + numbers_at[3 * i], memory + memory_at[3 * i]);
            w = creep(w, hold, numbers + numbers_at[3 * i + 1], memory + memory_at[3 * i + 1]);
            u[i] = w / asked[i];
        }
        for (long part = 0; part < parts; part++) {
            for (long g = 0; g < groups; g++) {
                long n = states[g], m = size[g], wide = 2 * m + 1, start = first[g];
                const double *a = within + within_at[g], *b = into + into_at[g];
                for (long row = 0; row < n; row++) {
                    double sum = b[row * wide + m];
                    for (long c = 0; c < m; c++)
                        sum += b[row * wide + c] * u[member[member_at[g] + c]];
                    for (long c = 0; c < n; c++)
                        sum += a[row * n + c] * x[start + c];
                    fresh[start + row] = sum;
                }
                for (long c = 0; c < m; c++) {
                    long i = member[member_at[g] + c];
                    double per_force = b[(rate[i] - start) * wide + m + 1 + c];
                    double force =
                        friction(fresh[rate[i]], per_force, numbers + numbers_at[3 * i + 2]);
                    for (long row = 0; row < n; row++)
                        fresh[start + row] += b[row * wide + m + 1 + c] * force;
                }
            }
            for (long n = 0; n < total; n++)
                x[n] = fresh[n];
        }
    }
    (void)place;
}
