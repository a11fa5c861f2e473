/* Which of the kernels this processor can run, and how large their structures are. */
#include "kernels.h"

#if defined(__x86_64__)
#include <cpuid.h>

/* By the processor itself: what compilers have for it is not there in every one's library. */
static int has_avx2_and_fma(void)
{
    unsigned a, b, c, d, low, high;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & bit_OSXSAVE) || !(c & bit_AVX) || !(c & bit_FMA))
        return 0;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    if ((low & 6) != 6) /* the system does not keep the vectors */
        return 0;
    return __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b & bit_AVX2);
}
#endif

/* Whether it has vectors of 32 bytes, and multiplies and adds at once: then those of level "v3" run, else "base". */
int has_v3(void)
{
#if defined(__x86_64__)
    return has_avx2_and_fma();
#else
    return 0;
#endif
}

/* Bytes, for whoever fills them from elsewhere. */
int size_of_mesh(void) { return (int)sizeof(Mesh); }

int size_of_parts(void) { return (int)sizeof(Parts); }
