/* For GCC 12, whose own header lets the compiler drop or move what is written to the memory that a
   tile is loaded from: the processor then refuses the configuration, or computes with what was
   there before. Put before every file of llama.cpp where the processor has tiles (setup.sh).
   Operands as in Intel's manual, volume 2: LDTILECFG, TILELOADD, TILESTORED. */
#include <immintrin.h>

#if defined(__AMX_TILE__) && defined(__GNUC__) && !defined(__clang__)

static inline __attribute__((always_inline)) void saca_load_tile_configuration(
    const void* configuration) {
  __asm__ volatile("ldtilecfg %0" : : "m"(*(const char(*)[64])configuration) : "memory");
}
#define _tile_loadconfig saca_load_tile_configuration

#undef _tile_loadd_internal
#define _tile_loadd_internal(to, from, stride)                     \
  __asm__ volatile("tileloadd (%0,%1,1), %%tmm" #to                \
                   :                                               \
                   : "r"((const void*)(from)), "r"((long)(stride)) \
                   : "memory")

#undef _tile_stored_internal
#define _tile_stored_internal(from, to, stride)            \
  __asm__ volatile("tilestored %%tmm" #from ", (%0,%1,1)"  \
                   :                                       \
                   : "r"((void*)(to)), "r"((long)(stride)) \
                   : "memory")

#endif
