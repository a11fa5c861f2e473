/* Kernels for a mapped mesh of cells of fourth order; fem/cell_native.py calls them, fem/cell_arrays.py does the same.

   Nodes are on a lattice of (4 rows + 1) by (4 columns + 1), cells in rows along s. A cell's nodes are numbered with
   the sixteen on its edge first, as in fem/tensor_product.py.

   LEVEL and BYTES name a kind of processor and the length of its vectors; every file is compiled once for each. */
#ifndef FLUXBORE_KERNELS_H
#define FLUXBORE_KERNELS_H

#include <stdint.h>

#define ORDER 4
#define SIDE 5     /* nodes, and Gauss points, along a side */
#define POINTS 25  /* of a cell; also its nodes */
#define EDGE 16    /* nodes on the edge of a cell */
#define INNER 9
#define PAIRS (EDGE * (EDGE + 1) / 2)
#define TILE 16    /* the band is kept in square tiles */

/* Eight numbers in double, sixteen in single precision, in as many registers as they take where vectors have BYTES. */
#define PARTS (64 / BYTES)
typedef double Doubles __attribute__((vector_size(BYTES), aligned(8), may_alias));
typedef float Singles __attribute__((vector_size(BYTES), aligned(4), may_alias));
typedef struct {
    Doubles part[PARTS];
} Eight;
typedef struct {
    Singles part[PARTS];
} Sixteen;

#define EACH for (int p_ = 0; p_ < PARTS; p_++)
#define INLINE static inline __attribute__((always_inline, unused))

INLINE Eight load8(const double *from)
{
    Eight found;
    EACH found.part[p_] = *((const Doubles *)from + p_);
    return found;
}

INLINE void store8(double *to, Eight what) { EACH *((Doubles *)to + p_) = what.part[p_]; }

INLINE Eight zero8(void)
{
    Eight found;
    EACH found.part[p_] = (Doubles){0};
    return found;
}

INLINE Eight scaled8(Eight a, double b)
{
    EACH a.part[p_] *= b;
    return a;
}

INLINE Eight times8(Eight a, Eight b)
{
    EACH a.part[p_] *= b.part[p_];
    return a;
}

INLINE Eight plus8(Eight sum, Eight a)
{
    EACH sum.part[p_] += a.part[p_];
    return sum;
}

/* sum + a b */
INLINE Eight plus_scaled8(Eight sum, Eight a, double b)
{
    EACH sum.part[p_] += a.part[p_] * b;
    return sum;
}

INLINE Sixteen load16(const float *from)
{
    Sixteen found;
    EACH found.part[p_] = *((const Singles *)from + p_);
    return found;
}

INLINE void store16(float *to, Sixteen what) { EACH *((Singles *)to + p_) = what.part[p_]; }

INLINE Sixteen zero16(void)
{
    Sixteen found;
    EACH found.part[p_] = (Singles){0};
    return found;
}

INLINE Sixteen scaled16(Sixteen a, float b)
{
    EACH a.part[p_] *= b;
    return a;
}

INLINE Sixteen plus16(Sixteen sum, Sixteen a)
{
    EACH sum.part[p_] += a.part[p_];
    return sum;
}

INLINE float lane16(Sixteen a, int k)
{
    const int lanes = BYTES / (int)sizeof(float);
    return a.part[k / lanes][k % lanes];
}

INLINE Sixteen plus_product16(Sixteen sum, Sixteen a, Sixteen b)
{
    EACH sum.part[p_] += a.part[p_] * b.part[p_];
    return sum;
}

INLINE Sixteen minus_product16(Sixteen sum, Sixteen a, Sixteen b)
{
    EACH sum.part[p_] -= a.part[p_] * b.part[p_];
    return sum;
}

/* sum - a b */
INLINE Sixteen minus_scaled16(Sixteen sum, Sixteen a, float b)
{
    EACH sum.part[p_] -= a.part[p_] * b;
    return sum;
}

INLINE float total16(Sixteen a)
{
    Singles sum = a.part[0];
    for (int p = 1; p < PARTS; p++)
        sum += a.part[p];
    float found = 0;
    for (unsigned i = 0; i < BYTES / sizeof(float); i++)
        found += sum[i];
    return found;
}

/* Each is compiled for several processors, and its name says for which. */
#define PASTE2(a, b) a##_##b
#define PASTE(a, b) PASTE2(a, b)
#define NAME(a) PASTE(a, LEVEL)

/* A mesh with its materials; everything that does not depend on the field. */
typedef struct {
    int64_t rows, columns;        /* of cells */
    const double *width;          /* (columns,) m^2 */
    const double *height;         /* (rows,) m */
    const double *inverse_radius; /* (columns, SIDE) 1/m at the Gauss points */
    const double *nu_r, *nu_z;    /* (cells,) m/H; zero in iron */
    const int32_t *curve;         /* (cells,) number of the iron's curve, or -1 */
    const int32_t *iron;          /* (irons,) cells of iron */
    const int32_t *others;        /* (cells - irons,) */
    int64_t irons;
    const int32_t *place;         /* (cells,) in `iron` or in `others` */
    const double *steps;          /* (curves,) T */
    const int64_t *intervals;     /* (curves,) */
    const double *coefficients;   /* (curves, most, 4) of H on each interval, lowest power first */
    int64_t most;
    const double *value, *slope;  /* (SIDE, SIDE) at each Gauss point of each node's polynomial along a side */
    const double *gauss;          /* (SIDE,) weights */
    const int32_t *nodes;         /* (POINTS, 2) row and column of each of a cell's nodes */
    const uint8_t *is_free;       /* (nodes of the lattice,) */
    const double *load;           /* (nodes of the lattice,) A */
    int64_t rim_edges;
    const int64_t *rim_nodes;     /* (rim_edges, SIDE) */
    const double *rim_matrices;   /* (rim_edges, SIDE, SIDE) */
    const double *across;         /* (POINTS, POINTS) on the unit square */
    const double *along;          /* (columns, POINTS, POINTS) on a column's unit square */
    int64_t unknowns;             /* of the condensed matrix */
    int64_t tiles;                /* in a column of the band, the diagonal one included */
    const int32_t *number;        /* (nodes of the lattice,) of a node's unknown, or -1 */
    const int32_t *target;        /* (cells, PAIRS) in the tiles, of each entry of the edge's lower triangle, or -1 */
} Mesh;

/* What was inside of cells: of each the rows of D^-1 and of D^-1 C^T, and what is left on its edge. */
typedef struct {
    float *edge;     /* (cells, EDGE, EDGE) */
    float *inverse;  /* (cells, INNER, EDGE), zero beyond INNER */
    float *coupling; /* (cells, INNER, EDGE) */
} Parts;

#endif
