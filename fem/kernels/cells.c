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
static void iron_at(const Mesh *m, int curve, Eight weight, Eight b_z, Eight b_r, Eight *h_z, Eight *h_r,
                    double *tensor, int64_t apart)
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

/* A row of cells at work. Gauss points along z are the lanes of a vector, five of eight; along s there is one for each
   node of the lattice: of psi, of its slope by z, and of what pulls on either. */
typedef struct {
    Eight *value, *slope, *pull_value, *pull_slope;
    double value_z[SIDE][8], slope_z[SIDE][8], weight_z[8];
} Row;

static void make_row(const Mesh *m, Eight *buffer, Row *row)
{
    const int64_t across = ORDER * m->columns + 1;
    memset(row, 0, sizeof *row);
    row->value = buffer;
    row->slope = buffer + across;
    row->pull_value = buffer + 2 * across;
    row->pull_slope = buffer + 3 * across;
    for (int q = 0; q < SIDE; q++) {
        for (int i = 0; i < SIDE; i++) {
            row->value_z[i][q] = m->value[q * SIDE + i];
            row->slope_z[i][q] = m->slope[q * SIDE + i];
        }
        row->weight_z[q] = m->gauss[q];
    }
}

/* From the nodes of a row to its Gauss points along z. */
static void read_nodes(Row *row, const double *psi, int64_t across)
{
    for (int64_t x = 0; x < across; x++) {
        Eight value = zero8(), slope = zero8();
        for (int i = 0; i < SIDE; i++) {
            value = plus_scaled8(value, load8(row->value_z[i]), psi[i * across + x]);
            slope = plus_scaled8(slope, load8(row->slope_z[i]), psi[i * across + x]);
        }
        row->value[x] = value;
        row->slope[x] = slope;
        row->pull_value[x] = row->pull_slope[x] = zero8();
    }
}

/* And what pulls at these points back to the nodes. */
static void add_to_nodes(const Row *row, double *out, int64_t across)
{
    for (int i = 0; i < SIDE; i++) {
        const Eight value = load8(row->value_z[i]), slope = load8(row->slope_z[i]);
        for (int64_t x = 0; x < across; x++) {
            double both[8];
            store8(both, plus8(times8(value, row->pull_value[x]), times8(slope, row->pull_slope[x])));
            out[i * across + x] += both[0] + both[1] + both[2] + both[3] + both[4];
        }
    }
}

/* What a cell adds to its row's pull. with_curves : of iron by its curve, writing the tensor; else by the tensor. */
static void pull_of_cell(const Mesh *m, const Row *row, int64_t cell, double *tensor, int with_curves)
{
    const int64_t column = cell % m->columns, first = ORDER * column, apart = m->irons * POINTS;
    const double width = m->width[column], height = m->height[cell / m->columns];
    double *own = m->curve[cell] < 0 ? 0 : tensor + (int64_t)m->place[cell] * POINTS;
    for (int p = 0; p < SIDE; p++) {
        const double *value_s = m->value + p * SIDE, *slope_s = m->slope + p * SIDE;
        const double steep = m->inverse_radius[column * SIDE + p] / height;
        Eight b_z = zero8(), b_r = zero8(), h_z, h_r;
        for (int j = 0; j < SIDE; j++) {
            b_z = plus_scaled8(b_z, row->value[first + j], slope_s[j]);
            b_r = plus_scaled8(b_r, row->slope[first + j], value_s[j]);
        }
        b_z = scaled8(b_z, 1 / width);
        b_r = scaled8(b_r, steep);
        const Eight weight = scaled8(load8(row->weight_z), width * height * m->gauss[p]);
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
            row->pull_value[first + j] = plus_scaled8(row->pull_value[first + j], h_z, slope_s[j]);
            row->pull_slope[first + j] = plus_scaled8(row->pull_slope[first + j], h_r, value_s[j]);
        }
    }
}

static void add_rim(const Mesh *m, const double *psi, double *out)
{
    for (int64_t k = 0; k < m->rim_edges; k++) {
        const int64_t *nodes = m->rim_nodes + k * SIDE;
        for (int i = 0; i < SIDE; i++)
            for (int j = 0; j < SIDE; j++)
                out[nodes[i]] += m->rim_matrices[(k * SIDE + i) * SIDE + j] * psi[nodes[j]];
    }
}

/* Nodal forces of nodal psi into `out`, zero where there is no freedom. Returns 0, or 1 where there is no memory. */
static int add_up(const Mesh *m, const double *psi, double *out, double *tensor, int with_curves)
{
    const int64_t across = ORDER * m->columns + 1, nodes = across * (ORDER * m->rows + 1);
    Eight *buffer = aligned_alloc(64, (size_t)(4 * across) * sizeof(Eight));
    if (!buffer)
        return 1;
    Row row;
    make_row(m, buffer, &row);
    memset(out, 0, (size_t)nodes * sizeof(double));
    for (int64_t k = 0; k < m->rows; k++) {
        read_nodes(&row, psi + ORDER * k * across, across);
        for (int64_t column = 0; column < m->columns; column++)
            pull_of_cell(m, &row, k * m->columns + column, tensor, with_curves);
        add_to_nodes(&row, out + ORDER * k * across, across);
    }
    free(buffer);
    add_rim(m, psi, out);
    for (int64_t n = 0; n < nodes; n++)
        out[n] = m->is_free[n] ? out[n] : 0.0;
    return 0;
}

/* Internal less external forces (A) of nodal psi, and the tensor (3, irons, POINTS) of their tangent. Returns 0, or 1
   where there is no memory. */
int NAME(residual)(const Mesh *m, const double *psi, double *out, double *tensor)
{
    if (add_up(m, psi, out, tensor, 1))
        return 1;
    const int64_t nodes = (ORDER * m->columns + 1) * (ORDER * m->rows + 1);
    for (int64_t n = 0; n < nodes; n++)
        out[n] -= m->load[n]; /* which is zero where there is no freedom */
    return 0;
}

/* The tangent with this tensor times nodal psi. Returns 0, or 1 where there is no memory. */
int NAME(product)(const Mesh *m, const double *tensor, const double *psi, double *out)
{
    return add_up(m, psi, out, (double *)tensor, 0); /* read alone */
}
