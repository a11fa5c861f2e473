/* Cells' matrices with what is inside of them condensed onto their edge; see kernels.h and fem/cell_matrices.py. */
#include "kernels.h"

#include <string.h>

#define WIDE 32 /* a row of a cell's matrix: the edge's columns, those inside, and seven that are zero */

typedef struct {
    double a[POINTS][WIDE] __attribute__((aligned(64)));
} Whole;

/* Gauss and Jordan's elimination of what is inside, which leaves D^-1, D^-1 C^T and K - C D^-1 C^T in place of D, C^T
   and K. No exchanges, which definite matrices do not need. Returns 0, or 1 where a pivot is not positive. */
static int eliminate(Whole *whole)
{
    double(*a)[WIDE] = whole->a;
    for (int k = EDGE; k < POINTS; k++) {
        const double pivot = a[k][k];
        if (!(pivot > 0))
            return 1;
        const double inverse = 1 / pivot;
        Eight row[WIDE / 8];
        for (int j = 0; j < WIDE / 8; j++)
            row[j] = scaled8(load8(a[k] + 8 * j), inverse);
        for (int i = 0; i < POINTS; i++) {
            const double factor = a[i][k];
            for (int j = 0; j < WIDE / 8; j++)
                store8(a[i] + 8 * j, plus_scaled8(load8(a[i] + 8 * j), row[j], -factor));
            a[i][k] = -factor * inverse;
        }
        for (int j = 0; j < WIDE / 8; j++)
            store8(a[k] + 8 * j, row[j]);
        a[k][k] = inverse;
    }
    return 0;
}

/* Rounded at the end only: digits lost on the way would cost a sweep of refinement more. */
static void store(const Whole *whole, const Parts *parts, int64_t k)
{
    float *edge = parts->edge + k * EDGE * EDGE;
    float *inverse = parts->inverse + k * INNER * EDGE, *coupling = parts->coupling + k * INNER * EDGE;
    for (int i = 0; i < EDGE; i++)
        for (int j = 0; j < EDGE; j++)
            edge[i * EDGE + j] = (float)whole->a[i][j];
    for (int i = 0; i < INNER; i++)
        for (int j = 0; j < EDGE; j++) {
            coupling[i * EDGE + j] = (float)whole->a[EDGE + i][j];
            inverse[i * EDGE + j] = (float)whole->a[EDGE + i][EDGE + j];
        }
}

/* All cells without iron. Returns 0, or 1 where one is not definite inside. */
int NAME(condense_linear)(const Mesh *m, const Parts *parts)
{
    const int64_t count = m->rows * m->columns - m->irons;
    Whole whole;
    memset(&whole, 0, sizeof whole);
    for (int64_t k = 0; k < count; k++) {
        const int64_t cell = m->others[k], row = cell / m->columns, column = cell % m->columns;
        const double aspect = m->height[row] / m->width[column];
        const double a = m->nu_z[cell] * aspect, b = m->nu_r[cell] / aspect;
        const double *along = m->along + column * POINTS * POINTS;
        for (int i = 0; i < POINTS; i++)
            for (int j = 0; j < POINTS; j++)
                whole.a[i][j] = a * m->across[i * POINTS + j] + b * along[i * POINTS + j];
        if (eliminate(&whole))
            return 1;
        store(&whole, parts, k);
    }
    return 0;
}

/* Products of two polynomials along a side at each Gauss point, by pair of nodes: (SIDE, 32), zero beyond 25. */
typedef struct {
    double values[SIDE][WIDE], slopes[SIDE][WIDE], value_slope[SIDE][WIDE], slope_value[SIDE][WIDE];
} Pairs;

static void make_pairs(const Mesh *m, Pairs *pairs)
{
    memset(pairs, 0, sizeof *pairs);
    for (int q = 0; q < SIDE; q++)
        for (int i = 0; i < SIDE; i++)
            for (int k = 0; k < SIDE; k++) {
                const double value = m->value[q * SIDE + i], slope = m->slope[q * SIDE + i];
                const double other = m->value[q * SIDE + k], steep = m->slope[q * SIDE + k];
                pairs->values[q][i * SIDE + k] = value * other;
                pairs->slopes[q][i * SIDE + k] = slope * steep;
                pairs->value_slope[q][i * SIDE + k] = value * steep;
                pairs->slope_value[q][i * SIDE + k] = slope * other;
            }
}

/* The matrix of a cell of iron from the tensor of its tangent, by the sums along z first and along s then. */
static void iron_matrix(const Mesh *m, const Pairs *pairs, int64_t cell, const double *tensor, Whole *whole)
{
    const int64_t row = cell / m->columns, column = cell % m->columns;
    const int64_t apart = m->irons * POINTS;
    const double width = m->width[column];
    Eight sums[4][SIDE][WIDE / 8];
    for (int p = 0; p < SIDE; p++) {
        const double steep = m->inverse_radius[column * SIDE + p] / m->height[row];
        for (int v = 0; v < WIDE / 8; v++) {
            Eight along_z = zero8(), mixed = zero8(), turned = zero8(), along_r = zero8();
            for (int q = 0; q < SIDE; q++) {
                const double *at = tensor + q * SIDE + p;
                along_z = plus_scaled8(along_z, load8(pairs->values[q] + 8 * v), at[0]);
                mixed = plus_scaled8(mixed, load8(pairs->value_slope[q] + 8 * v), at[apart]);
                turned = plus_scaled8(turned, load8(pairs->slope_value[q] + 8 * v), at[apart]);
                along_r = plus_scaled8(along_r, load8(pairs->slopes[q] + 8 * v), at[2 * apart]);
            }
            sums[0][p][v] = scaled8(along_z, 1 / (width * width));
            sums[1][p][v] = scaled8(mixed, steep / width);
            sums[2][p][v] = scaled8(turned, steep / width);
            sums[3][p][v] = scaled8(along_r, steep * steep);
        }
    }
    int local[SIDE][SIDE];
    for (int n = 0; n < POINTS; n++)
        local[m->nodes[2 * n]][m->nodes[2 * n + 1]] = n;
    for (int j = 0; j < SIDE; j++)
        for (int l = 0; l <= j; l++) {
            const int pair = j * SIDE + l;
            double found[WIDE] __attribute__((aligned(64)));
            for (int v = 0; v < WIDE / 8; v++) {
                Eight sum = zero8();
                for (int p = 0; p < SIDE; p++) {
                    sum = plus_scaled8(sum, sums[0][p][v], pairs->slopes[p][pair]);
                    sum = plus_scaled8(sum, sums[1][p][v], pairs->slope_value[p][pair]);
                    sum = plus_scaled8(sum, sums[2][p][v], pairs->value_slope[p][pair]);
                    sum = plus_scaled8(sum, sums[3][p][v], pairs->values[p][pair]);
                }
                store8(found + 8 * v, sum);
            }
            for (int i = 0; i < SIDE; i++)
                for (int k = 0; k < SIDE; k++) {
                    const int one = local[i][j], other = local[k][l];
                    whole->a[one][other] = whole->a[other][one] = found[i * SIDE + k];
                }
        }
}

/* All cells of iron, from their tangent's tensor (3, irons, POINTS). Returns 0, or 1 where one is not definite
   inside. */
int NAME(condense_iron)(const Mesh *m, const double *tensor, const Parts *parts)
{
    Pairs pairs __attribute__((aligned(64)));
    Whole whole;
    make_pairs(m, &pairs);
    memset(&whole, 0, sizeof whole);
    for (int64_t k = 0; k < m->irons; k++) {
        iron_matrix(m, &pairs, m->iron[k], tensor + k * POINTS, &whole);
        if (eliminate(&whole))
            return 1;
        store(&whole, parts, k);
    }
    return 0;
}
