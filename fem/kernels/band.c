/* Cholesky's factor of the condensed matrix's band, in single precision and in tiles; see kernels.h.

   Columns of the band are kept by sixteen: the diagonal tile first and the tiles below it next, each by columns. */
#include "kernels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TILE_SIZE (TILE * TILE)

/* Columns of a product that are made at once: what registers hold. */
#define GROUP (BYTES == 32 ? 4 : 2)

static void add_edges(const Mesh *m, float *band, const int32_t *cells, int64_t count, const float *edge)
{
    for (int64_t k = 0; k < count; k++, edge += EDGE * EDGE) {
        const int32_t *target = m->target + (int64_t)cells[k] * PAIRS;
        for (int i = 0; i < EDGE; i++)
            for (int j = 0; j <= i; j++, target++)
                if (*target >= 0)
                    band[*target] += edge[i * EDGE + j];
    }
}

static void add_rim(const Mesh *m, float *band)
{
    for (int64_t k = 0; k < m->rim_edges; k++)
        for (int i = 0; i < SIDE; i++)
            for (int j = 0; j < SIDE; j++) {
                const int32_t row = m->number[m->rim_nodes[k * SIDE + i]];
                const int32_t column = m->number[m->rim_nodes[k * SIDE + j]];
                if (column < 0 || row < column)
                    continue;
                const int64_t tile = column / TILE * m->tiles + row / TILE - column / TILE;
                band[tile * TILE_SIZE + column % TILE * TILE + row % TILE] +=
                    (float)m->rim_matrices[(k * SIDE + i) * SIDE + j];
            }
}

/* The factor of a diagonal tile in place: zero above the diagonal, on which are inverses. Returns 0, or 1 where a pivot
   is not positive. */
static int factor_diagonal(float *tile)
{
    for (int k = 0; k < TILE; k++) {
        const float pivot = tile[k * TILE + k];
        if (!(pivot > 0))
            return 1;
        for (int i = 0; i < k; i++)
            tile[k * TILE + i] = 0;
        const float inverse = 1 / sqrtf(pivot);
        const Sixteen column = scaled16(load16(tile + k * TILE), inverse);
        store16(tile + k * TILE, column);
        tile[k * TILE + k] = inverse;
        for (int j = k + 1; j < TILE; j++)
            store16(tile + j * TILE, minus_scaled16(load16(tile + j * TILE), column, tile[k * TILE + j]));
    }
    return 0;
}

/* X with X L^T = the tile, in its place. */
static void solve_tile(const float *diagonal, float *tile)
{
    for (int k = 0; k < TILE; k++) {
        Sixteen x = load16(tile + k * TILE);
        for (int j = 0; j < k; j++)
            x = minus_scaled16(x, load16(tile + j * TILE), diagonal[j * TILE + k]);
        store16(tile + k * TILE, scaled16(x, diagonal[k * TILE + k]));
    }
}

/* target -= a b^T */
static void subtract_product(float *target, const float *a, const float *b)
{
    for (int first = 0; first < TILE; first += GROUP) {
        Sixteen sum[GROUP];
        for (int j = 0; j < GROUP; j++)
            sum[j] = load16(target + (first + j) * TILE);
        for (int k = 0; k < TILE; k++) {
            const Sixteen column = load16(a + k * TILE);
            for (int j = 0; j < GROUP; j++)
                sum[j] = minus_scaled16(sum[j], column, b[k * TILE + first + j]);
        }
        for (int j = 0; j < GROUP; j++)
            store16(target + (first + j) * TILE, sum[j]);
    }
}

/* The band (blocks, tiles, TILE, TILE) of all cells' edges and the rim's, factorised. Returns 0, or 1 where the matrix
   is not positive definite. */
int NAME(factorise)(const Mesh *m, const float *linear, const float *iron, float *band)
{
    const int64_t blocks = (m->unknowns + TILE - 1) / TILE, tiles = m->tiles;
    memset(band, 0, (size_t)(blocks * tiles * TILE_SIZE) * sizeof(float));
    add_edges(m, band, m->others, m->rows * m->columns - m->irons, linear);
    add_edges(m, band, m->iron, m->irons, iron);
    add_rim(m, band);
    for (int64_t k = m->unknowns; k < blocks * TILE; k++) /* the last tiles are filled up */
        band[(blocks - 1) * tiles * TILE_SIZE + k % TILE * TILE + k % TILE] = 1;
    for (int64_t block = 0; block < blocks; block++) {
        float *column = band + block * tiles * TILE_SIZE;
        const int64_t below = blocks - block < tiles ? blocks - block : tiles;
        if (factor_diagonal(column))
            return 1;
        for (int64_t i = 1; i < below; i++)
            solve_tile(column, column + i * TILE_SIZE);
        for (int64_t j = 1; j < below; j++)
            for (int64_t i = j; i < below; i++)
                subtract_product(column + (j * tiles + i - j) * TILE_SIZE, column + i * TILE_SIZE,
                                 column + j * TILE_SIZE);
    }
    return 0;
}

/* x with L L^T x = the right side (blocks * TILE,), in its place, one block of it after another. */
static void forward(const float *column, int64_t below, float *x)
{
    Sixteen rest = load16(x);
    for (int k = 0; k < TILE; k++) {
        const float y = lane16(rest, k) * column[k * TILE + k];
        rest = minus_scaled16(rest, load16(column + k * TILE), y);
        x[k] = y;
    }
    for (int64_t i = 1; i < below; i++) {
        Sixteen even = load16(x + i * TILE), odd = zero16();
        for (int k = 0; k < TILE; k += 2) {
            even = minus_scaled16(even, load16(column + (i * TILE + k) * TILE), x[k]);
            odd = minus_scaled16(odd, load16(column + (i * TILE + k + 1) * TILE), x[k + 1]);
        }
        store16(x + i * TILE, plus16(even, odd));
    }
}

static void backward(const float *column, int64_t below, float *x)
{
    for (int k = TILE - 1; k >= 0; k--) {
        Sixteen sum = zero16();
        for (int64_t i = 1; i < below; i++)
            sum = plus_product16(sum, load16(column + (i * TILE + k) * TILE), load16(x + i * TILE));
        x[k] -= total16(sum);
    }
    for (int k = TILE - 1; k >= 0; k--) {
        for (int j = k + 1; j < TILE; j++)
            x[k] -= column[k * TILE + j] * x[j];
        x[k] *= column[k * TILE + k];
    }
}

/* Of a right side's nodal values those on the cells' edges less C D^-1 times those inside. */
static void condense_right(const Mesh *m, int64_t cell, const Parts *parts, int64_t k, float *nodal)
{
    const int64_t across = ORDER * m->columns + 1;
    float *first = nodal + ORDER * (cell / m->columns) * across + ORDER * (cell % m->columns);
    Sixteen sum = zero16();
    for (int i = 0; i < INNER; i++) {
        const float inside = first[m->nodes[2 * (EDGE + i)] * across + m->nodes[2 * (EDGE + i) + 1]];
        sum = minus_scaled16(sum, load16(parts->coupling + (k * INNER + i) * EDGE), inside);
    }
    float pull[EDGE];
    store16(pull, sum);
    for (int i = 0; i < EDGE; i++)
        first[m->nodes[2 * i] * across + m->nodes[2 * i + 1]] += pull[i];
}

/* What is inside of a cell, from the right side there and the solution on its edge. */
static void spread_inside(const Mesh *m, int64_t cell, const Parts *parts, int64_t k, float *nodal)
{
    const int64_t across = ORDER * m->columns + 1;
    float *first = nodal + ORDER * (cell / m->columns) * across + ORDER * (cell % m->columns);
    float edge[EDGE], inside[EDGE] = {0};
    for (int i = 0; i < EDGE; i++)
        edge[i] = first[m->nodes[2 * i] * across + m->nodes[2 * i + 1]];
    for (int i = 0; i < INNER; i++)
        inside[i] = first[m->nodes[2 * (EDGE + i)] * across + m->nodes[2 * (EDGE + i) + 1]];
    for (int i = 0; i < INNER; i++) {
        Sixteen both = zero16();
        both = plus_product16(both, load16(parts->inverse + (k * INNER + i) * EDGE), load16(inside));
        both = minus_product16(both, load16(parts->coupling + (k * INNER + i) * EDGE), load16(edge));
        first[m->nodes[2 * (EDGE + i)] * across + m->nodes[2 * (EDGE + i) + 1]] = total16(both);
    }
}

/* Nodal x (count, nodes) with A x = the nodal right sides (count, nodes), by A's factor; zero where there is no
   freedom. What is read of the factor serves all right sides at once. Returns 0, or 1 where there is no memory. */
int NAME(solve)(const Mesh *m, const float *band, const Parts *linear, const Parts *iron, int64_t count,
                const double *right, double *out)
{
    const int64_t nodes = (ORDER * m->columns + 1) * (ORDER * m->rows + 1), cells = m->rows * m->columns;
    const int64_t blocks = (m->unknowns + TILE - 1) / TILE, size = blocks * TILE, tiles = m->tiles;
    float *nodal = malloc((size_t)(count * nodes) * sizeof(float)), *x = calloc((size_t)(count * size), sizeof(float));
    double *scale = malloc((size_t)count * sizeof(double)); /* within what single precision can hold */
    if (!nodal || !x || !scale) {
        free(nodal);
        free(x);
        free(scale);
        return 1;
    }
    for (int64_t c = 0; c < count; c++) {
        const double *from = right + c * nodes;
        double largest = 0;
        for (int64_t n = 0; n < nodes; n++)
            largest = fabs(from[n]) <= largest ? largest : fabs(from[n]); /* what is not a number stays so */
        scale[c] = largest == 0 ? 1 : largest;
        for (int64_t n = 0; n < nodes; n++)
            nodal[c * nodes + n] = (float)(from[n] / scale[c]);
    }
    for (int64_t cell = 0; cell < cells; cell++)
        for (int64_t c = 0; c < count; c++)
            condense_right(m, cell, m->curve[cell] < 0 ? linear : iron, m->place[cell], nodal + c * nodes);
    for (int64_t c = 0; c < count; c++)
        for (int64_t n = 0; n < nodes; n++)
            if (m->number[n] >= 0)
                x[c * size + m->number[n]] = nodal[c * nodes + n];
    for (int64_t block = 0; block < blocks; block++)
        for (int64_t c = 0; c < count; c++)
            forward(band + block * tiles * TILE_SIZE, blocks - block < tiles ? blocks - block : tiles,
                    x + c * size + block * TILE);
    for (int64_t block = blocks - 1; block >= 0; block--)
        for (int64_t c = 0; c < count; c++)
            backward(band + block * tiles * TILE_SIZE, blocks - block < tiles ? blocks - block : tiles,
                     x + c * size + block * TILE);
    for (int64_t c = 0; c < count; c++)
        for (int64_t n = 0; n < nodes; n++)
            if (m->number[n] >= 0)
                nodal[c * nodes + n] = x[c * size + m->number[n]];
            else if (!m->is_free[n])
                nodal[c * nodes + n] = 0;
    for (int64_t cell = 0; cell < cells; cell++)
        for (int64_t c = 0; c < count; c++)
            spread_inside(m, cell, m->curve[cell] < 0 ? linear : iron, m->place[cell], nodal + c * nodes);
    for (int64_t c = 0; c < count; c++)
        for (int64_t n = 0; n < nodes; n++)
            out[c * nodes + n] = nodal[c * nodes + n] * scale[c];
    free(nodal);
    free(x);
    free(scale);
    return 0;
}
