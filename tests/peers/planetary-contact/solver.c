/* Classical Runge-Kutta integration of a planetary gearbox whose tooth pairs push one by one (PHYSICS of
   README.md). Compiled and called by planetary.py. SI units; time in mesh periods except where named. */
#include <math.h>
#include <string.h>

#define MAX_DOF 27
#define MAX_SLICES 256

typedef struct {
    int nodes;         /* of the tables, uniform over [low, high] */
    double low, high;  /* tau, mesh periods since the start of the nominal path: no contact outside */
    const double *stiffness, *gap; /* of one tooth pair of the full face width, free of index errors */
    double contact_ratio;
    int slices;               /* of the face width; 1 for spur gears */
    double delay;             /* mesh periods by which the last slice lags the first */
    double damping_factor;    /* 2 zeta sqrt(m1 m2 / (m1 + m2)) */
} Mesh;

typedef struct {
    int kind;               /* index of its Mesh */
    double start;           /* mesh period at which tooth pair 0 starts its nominal contact */
    double line[MAX_DOF];   /* row vector v: compression = v q */
    const double *error_one, *error_two;  /* of each gear's teeth */
    int teeth_one, teeth_two, first_one, first_two;  /* tooth of pair j: (first + j) mod teeth */
    double time_in, time_out;  /* of nominal contact time: pushing, not pushing */
} Contact;

typedef struct {
    int dof, contacts;
    double mass[MAX_DOF], force[MAX_DOF];
    const double *stiffness, *damping; /* dof x dof, bearings, supports and gyroscopic terms */
    double period;                     /* s */
    Mesh *meshes;
    Contact *contact;
} Gearbox;

static double table(const double *values, int nodes, double low, double high, double at) {
    double x = (at - low) / (high - low) * (nodes - 1);
    int i = (int)x;
    if (i < 0) i = 0;
    if (i > nodes - 2) i = nodes - 2;
    return values[i] + (x - i) * (values[i + 1] - values[i]);
}

static int wrap(long j, int n) { return (int)(((j % n) + n) % n); }

/* Force of a mesh at compression d and rate d1. watch > 0: adds that time to the contact shares. */
static double mesh_force(const Gearbox *g, Contact *c, double t, double d, double d1, double watch) {
    const Mesh *m = &g->meshes[c->kind];
    const double phase = t - c->start;
    const double delay_half = 0.5 * fabs(m->delay);
    double elastic = 0.0, nominal_k = 0.0;
    for (long j = (long)ceil(phase - m->high - delay_half); j <= (long)floor(phase - m->low + delay_half); ++j) {
        const double e = c->error_one[wrap(c->first_one + j, c->teeth_one)] +
                         c->error_two[wrap(c->first_two + j, c->teeth_two)];
        for (int i = 0; i < m->slices; ++i) {
            const double tau = phase - j - m->delay * ((i + 0.5) / m->slices - 0.5);
            if (tau <= m->low || tau >= m->high) continue;
            const int inside = tau > 0.0 && tau < m->contact_ratio;
            const double gap = table(m->gap, m->nodes, m->low, m->high, tau);
            const double k = table(m->stiffness, m->nodes, m->low, m->high, tau) / m->slices;
            const int touches = d > e + gap;
            if (inside) {
                nominal_k += k;
                if (watch > 0.0) *(touches ? &c->time_in : &c->time_out) += watch;
            }
            if (touches) elastic += k * (d - e - gap);
        }
    }
    if (elastic <= 0.0) return 0.0;
    return elastic + m->damping_factor * sqrt(nominal_k) * d1;
}

static void accelerations(const Gearbox *g, double t, const double *q, const double *v, double *a, double *forces,
                          double watch) {
    const int n = g->dof;
    for (int i = 0; i < n; ++i) {
        double f = g->force[i];
        for (int j = 0; j < n; ++j) f -= g->stiffness[i * n + j] * q[j] + g->damping[i * n + j] * v[j];
        a[i] = f;
    }
    for (int c = 0; c < g->contacts; ++c) {
        Contact *contact = &g->contact[c];
        double d = 0.0, d1 = 0.0;
        for (int i = 0; i < n; ++i) {
            d += contact->line[i] * q[i];
            d1 += contact->line[i] * v[i];
        }
        const double f = mesh_force(g, contact, t, d, d1, watch);
        if (forces) forces[c] = f;
        for (int i = 0; i < n; ++i) a[i] -= f * contact->line[i];
    }
    for (int i = 0; i < n; ++i) a[i] /= g->mass[i];
}

/* Integrates from node to node of `times` (mesh periods). Where `record[i]` is not 0, the state at times[i] is
   appended to out: q, v, accelerations, mesh forces. Contact shares count from times[i] >= share_from. */
void integrate(const Gearbox *g, const double *times, const unsigned char *record, long nodes, double share_from,
               double *state, double *out) {
    const int n = g->dof;
    const double inward = 1e-7; /* of a step: both sides of a jump at a node are evaluated on their own side */
    double *q = state, *v = state + n;
    for (long s = 0; s < nodes; ++s) {
        const double t = times[s];
        if (record[s]) {
            memcpy(out, q, n * sizeof *out);
            memcpy(out + n, v, n * sizeof *out);
            accelerations(g, t, q, v, out + 2 * n, out + 3 * n, 0.0);
            out += 3 * n + g->contacts;
        }
        if (s + 1 == nodes) break;
        const double step = times[s + 1] - t, h = step * g->period;
        double a1[MAX_DOF], a2[MAX_DOF], a3[MAX_DOF], a4[MAX_DOF], q2[MAX_DOF], v2[MAX_DOF], v3[MAX_DOF],
            v4[MAX_DOF];
        accelerations(g, t + inward * step, q, v, a1, 0, t >= share_from ? step : 0.0);
        for (int i = 0; i < n; ++i) q2[i] = q[i] + 0.5 * h * v[i], v2[i] = v[i] + 0.5 * h * a1[i];
        accelerations(g, t + 0.5 * step, q2, v2, a2, 0, 0.0);
        for (int i = 0; i < n; ++i) q2[i] = q[i] + 0.5 * h * v2[i], v3[i] = v[i] + 0.5 * h * a2[i];
        accelerations(g, t + 0.5 * step, q2, v3, a3, 0, 0.0);
        for (int i = 0; i < n; ++i) q2[i] = q[i] + h * v3[i], v4[i] = v[i] + h * a3[i];
        accelerations(g, t + (1.0 - inward) * step, q2, v4, a4, 0, 0.0);
        for (int i = 0; i < n; ++i) {
            q[i] += h / 6.0 * (v[i] + 2.0 * v2[i] + 2.0 * v3[i] + v4[i]);
            v[i] += h / 6.0 * (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]);
        }
    }
}
