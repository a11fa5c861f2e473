/* A field's forces on the nodes of a mapped mesh, and the tangent's; see kernels.h. */
#include "kernels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A column of a cell's Gauss points, five along z, and three zeros. */
INLINE Eight load_column(const double *from)
{
    double found[8] = {0};
    for (int q = 0; q < SIDE; q++)
        found[q] = from[q * SIDE];
    return load8(found);
}

/* At a column of points of iron H times the quadrature weight, and the tensor of its derivative by B, whose three parts
   are `apart` from one another. */
static void iron_at(const Mesh *m, int curve, Eight weight, Eight b_z, Eight b_r, Eight *h_z, Eight *h_r, double *tensor,
                    int64_t apart)
{
    double w[8], z[8], r[8], nu[8] = {0}, bent[8] = {0};
    store8(w, weight);
    store8(z, b_z);
    store8(r, b_r);
    const double step = m->steps[curve], last = (double)(m->intervals[curve] - 1);
    for (int q = 0; q < SIDE; q++) {
        const double squared = z[q] * z[q] + r[q] * r[q], b = sqrt(squared), share = b / step;
        /* What is not a number goes to the last interval, where it stays so. */
        const int64_t k = (int64_t)(share < last ? share : last);
        const double x = b - (double)k * step, *c = m->coefficients + (curve * m->most + k) * 4;
        if (k == 0) { /* H is odd in B: no division by a vanishing B */
            nu[q] = w[q] * (c[1] + c[3] * x * x);
            bent[q] = w[q] * 2 * c[3];
        } else {
            const double found = (c[0] + x * (c[1] + x * (c[2] + x * c[3]))) / b;
            nu[q] = w[q] * found;
            bent[q] = w[q] * (c[1] + x * (2 * c[2] + 3 * c[3] * x) - found) / squared;
        }
        tensor[q * SIDE] = nu[q] + bent[q] * z[q] * z[q];
        tensor[apart + q * SIDE] = bent[q] * z[q] * r[q];
        tensor[2 * apart + q * SIDE] = nu[q] + bent[q] * r[q] * r[q];
    }
    *h_z = times8(load8(nu), b_z);
    *h_r = times8(load8(nu), b_r);
}

/* Nodal forces (A) of nodal psi into `out`: with curves, less the load, and the tensor (3, irons, POINTS) is written; else
   the tangent's with that tensor. Zero where there is no freedom. Returns 0, or 1 where there is no memory. */
static int sweep(const Mesh *m, const double *psi, double *out, double *tensor, int with_curves)
{
    const int64_t across = ORDER * m->columns + 1, nodes = across * (ORDER * m->rows + 1), apart = m->irons * POINTS;
    /* Gauss points along z are the lanes of a vector, five of eight. */
    Eight *buffer = aligned_alloc(64, (size_t)(4 * across) * sizeof(Eight));
    if (!buffer)
        return 1;
    Eight *value = buffer, *slope = buffer + across, *pull_value = slope + across, *pull_slope = pull_value + across;
    double value_z[SIDE][8] = {{0}}, slope_z[SIDE][8] = {{0}}, weight_z[8] = {0};
    for (int q = 0; q < SIDE; q++) {
        for (int i = 0; i < SIDE; i++) {
            value_z[i][q] = m->value[q * SIDE + i];
            slope_z[i][q] = m->slope[q * SIDE + i];
        }
        weight_z[q] = m->gauss[q];
    }
    memset(out, 0, (size_t)nodes * sizeof(double));
    for (int64_t row = 0; row < m->rows; row++) {
        const double height = m->height[row];
        const double *here = psi + ORDER * row * across;
        for (int64_t x = 0; x < across; x++) {
            Eight a = zero8(), c = zero8();
            for (int i = 0; i < SIDE; i++) {
                a = plus_scaled8(a, load8(value_z[i]), here[i * across + x]);
                c = plus_scaled8(c, load8(slope_z[i]), here[i * across + x]);
            }
            value[x] = a;
            slope[x] = c;
            pull_value[x] = pull_slope[x] = zero8();
        }
        for (int64_t column = 0; column < m->columns; column++) {
            const int64_t cell = row * m->columns + column, first = ORDER * column;
            const double width = m->width[column];
            double *own = m->curve[cell] < 0 ? 0 : tensor + (int64_t)m->place[cell] * POINTS;
            for (int p = 0; p < SIDE; p++) {
                const double *value_s = m->value + p * SIDE, *slope_s = m->slope + p * SIDE;
                const double steep = m->inverse_radius[column * SIDE + p] / height;
                Eight b_z = zero8(), b_r = zero8();
                for (int j = 0; j < SIDE; j++) {
                    b_z = plus_scaled8(b_z, value[first + j], slope_s[j]);
                    b_r = plus_scaled8(b_r, slope[first + j], value_s[j]);
                }
                b_z = scaled8(b_z, 1 / width);
                b_r = scaled8(b_r, steep);
                const Eight weight = scaled8(load8(weight_z), width * height * m->gauss[p]);
                Eight h_z, h_r;
                if (!own) {
                    h_z = times8(scaled8(weight, m->nu_z[cell]), b_z);
                    h_r = times8(scaled8(weight, m->nu_r[cell]), b_r);
                } else if (with_curves) {
                    iron_at(m, m->curve[cell], weight, b_z, b_r, &h_z, &h_r, own + p, apart);
                } else {
                    const Eight mixed = load_column(own + apart + p);
                    h_z = plus8(times8(load_column(own + p), b_z), times8(mixed, b_r));
                    h_r = plus8(times8(mixed, b_z), times8(load_column(own + 2 * apart + p), b_r));
                }
                h_z = scaled8(h_z, 1 / width);
                h_r = scaled8(h_r, steep);
                for (int j = 0; j < SIDE; j++) {
                    pull_value[first + j] = plus_scaled8(pull_value[first + j], h_z, slope_s[j]);
                    pull_slope[first + j] = plus_scaled8(pull_slope[first + j], h_r, value_s[j]);
                }
            }
        }
        double *there = out + ORDER * row * across;
        for (int i = 0; i < SIDE; i++)
            for (int64_t x = 0; x < across; x++) {
                double both[8];
                store8(both, plus8(times8(load8(value_z[i]), pull_value[x]), times8(load8(slope_z[i]), pull_slope[x])));
                there[i * across + x] += both[0] + both[1] + both[2] + both[3] + both[4];
            }
    }
    free(buffer);
    for (int64_t k = 0; k < m->rim_edges; k++)
        for (int i = 0; i < SIDE; i++) {
            double pull = 0;
            for (int j = 0; j < SIDE; j++)
                pull += m->rim_matrices[(k * SIDE + i) * SIDE + j] * psi[m->rim_nodes[k * SIDE + j]];
            out[m->rim_nodes[k * SIDE + i]] += pull;
        }
    for (int64_t n = 0; n < nodes; n++)
        out[n] = m->is_free[n] ? out[n] - (with_curves ? m->load[n] : 0.0) : 0.0;
    return 0;
}

int NAME(residual)(const Mesh *m, const double *psi, double *out, double *tensor)
{
    return sweep(m, psi, out, tensor, 1);
}

int NAME(product)(const Mesh *m, const double *tensor, const double *psi, double *out)
{
    return sweep(m, psi, out, (double *)tensor, 0);
}
