/* Which of the kernels this processor can run, and how large their structures are. */
#include "kernels.h"

/* Whether it has vectors of 32 bytes, and multiplies and adds at once: then those of level "v3" run, else "base". */
int has_v3(void)
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    return 0;
#endif
}

/* Bytes, for whoever fills them from elsewhere. */
int size_of_mesh(void) { return (int)sizeof(Mesh); }

int size_of_parts(void) { return (int)sizeof(Parts); }
