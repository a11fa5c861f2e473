"""Equations (36) and (37) as the paper's appendix prints them, for comparison only."""


def published_numerator(k):
    """(36), the constant first."""
    g_D, g_v, K_e, D_e = k.g_D, k.g_v, k.K_e, k.D_e
    gain = k.K_p * k.K_t * k.K_v
    return (
        g_D * g_v * K_e * gain,
        D_e * g_D * g_v * gain + g_D * K_e * gain + g_v * K_e * gain,
        D_e * g_D * gain + D_e * g_v * gain + K_e * gain,
        D_e * gain,
    )


def published_denominator(k):
    """(37), the constant first."""
    J, M, h, K_l, K_e, D_e = k.J, k.M, k.h, k.K_l, k.K_e, k.D_e
    K_p, K_t, K_v, g_D, g_v = k.K_p, k.K_t, k.K_v, k.g_D, k.g_v
    return (
        g_D * g_v * K_e * K_p * K_t * K_v,
        g_v * h**2 * K_e * K_l
        + g_D * g_v * K_e * K_t * K_v
        + g_D * g_v * K_l * K_t * K_v
        + D_e * g_D * g_v * K_p * K_t * K_v
        + g_D * K_e * K_p * K_t * K_v
        + g_v * K_e * K_p * K_t * K_v,
        g_D * g_v * J * K_e
        + D_e * g_v * h**2 * K_l
        + g_D * g_v * J * K_l
        + h**2 * K_e * K_l
        + D_e * g_D * g_v * K_t * K_v
        + g_v * K_e * K_t * K_v
        + g_v * K_l * K_t * K_v
        + D_e * g_D * K_p * K_t * K_v
        + D_e * g_v * K_p * K_t * K_v
        + K_e * K_p * K_t * K_v
        + g_D * g_v * K_p * K_t * K_v * M,
        D_e * g_D * g_v * J
        + g_D * J * K_e
        + g_v * J * K_e
        + D_e * h**2 * K_l
        + g_D * J * K_l
        + g_v * J * K_l
        + D_e * g_v * K_t * K_v
        + D_e * K_p * K_t * K_v
        + g_v * h**2 * K_l * M
        + g_D * g_v * K_t * K_v * M
        + g_D * K_p * K_t * K_v * M
        + g_v * K_p * K_t * K_v * M,
        D_e * g_D * J
        + D_e * g_v * J
        + J * K_e
        + J * K_l
        + g_D * g_v * J * M
        + h**2 * K_l * M
        + g_v * K_t * K_v * M
        + K_p * K_t * K_v * M,
        D_e * J + g_D * J * M + g_v * J * M,
        J * M,
    )
